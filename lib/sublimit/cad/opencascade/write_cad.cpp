// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/opencascade/write_cad.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepTools.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TCollection_HAsciiString.hxx>
#include <XSControl_WorkSession.hxx>

#include <mutex>
#include <sstream>

#include "sublimit/base/error.h"
#include "sublimit/cad/opencascade/shape.h"

namespace sublimit {
namespace {

std::string step_text(const TopoDS_Shape& shape, const std::string& name) {
  STEPControl_Writer writer;
  Interface_Static::SetIVal("write.surfacecurve.mode", 0);  // readers find curves in parameters again: lines
  Interface_Static::SetCVal("write.step.product.name", name.c_str());
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone)
    throw AnalysisError("OpenCASCADE could not make a STEP model of the surface");
  const Handle(StepData_StepModel) model = writer.Model();
  APIHeaderSection_MakeHeader header(model);
  header.SetName(new TCollection_HAsciiString(name.c_str()));
  header.SetTimeStamp(new TCollection_HAsciiString("1970-01-01T00:00:00"));  // equal input, equal bytes
  header.SetAuthorValue(1, new TCollection_HAsciiString(""));
  header.SetOriginatingSystem(new TCollection_HAsciiString("sublimit"));
  header.Apply(model);
  StepData_StepWriter text(model);
  text.FloatWriter().SetFormat("%.16E");  // OpenCASCADE's own has 13 digits
  text.SendModel(Handle(StepData_Protocol)::DownCast(writer.WS()->Protocol()));
  std::ostringstream out;
  if (!text.Print(out)) throw AnalysisError("OpenCASCADE could not print the STEP model");
  return out.str();
}

}  // namespace

CadFile cad_file(const BoundaryModel& model, const std::string& name, bool step) {
  static std::mutex one_at_a_time;  // its settings are the program's
  const std::lock_guard lock(one_at_a_time);
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  try {
    const ModelShape made = shape_of(model);
    CadFile file{{}, made.solids, made.shells, made.is_valid};
    if (step) {
      file.bytes = step_text(made.shape, name);
    } else {
      std::ostringstream out;
      BRepTools::Write(made.shape, out);
      file.bytes = out.str();
    }
    return file;
  } catch (const Standard_Failure& failure) {
    throw AnalysisError(std::string("OpenCASCADE: ") + failure.GetMessageString());
  }
}

}  // namespace sublimit
