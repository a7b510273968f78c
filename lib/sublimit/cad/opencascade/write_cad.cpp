// SPDX-License-Identifier: Apache-2.0
#include "sublimit/cad/opencascade/write_cad.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepTools.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <Quantity_Color.hxx>
#include <STEPConstruct.hxx>
#include <STEPConstruct_Styles.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <Standard_OutOfMemory.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <StepRepr_RepresentationContext.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepVisual_Colour.hxx>
#include <StepVisual_MechanicalDesignGeometricPresentationRepresentation.hxx>
#include <StepVisual_PresentationStyleAssignment.hxx>
#include <StepVisual_StyledItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <Transfer_FinderProcess.hxx>
#include <XSControl_TransferWriter.hxx>
#include <XSControl_WorkSession.hxx>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <new>
#include <sstream>
#include <string_view>

#include "sublimit/base/detail/terminate_as_bad_alloc.h"
#include "sublimit/base/error.h"
#include "sublimit/cad/opencascade/shape.h"

namespace sublimit {
namespace {

/// What OpenCASCADE says that it cannot do.
struct Refused {
  std::string why;
};

/// What stands for the backslash of a directive: the writer doubles those that it is given.
constexpr char directive = '\1';

/// UTF-8 as strings of STEP files have it: what is not ASCII by directives with hexadecimal digits (ISO 10303-21,
/// 6.4.3). Quotes and backslashes are the writer's business.
std::string step_string(std::string_view utf8) {
  std::string text;
  for (size_t i = 0; i < utf8.size();) {
    const auto first = static_cast<unsigned char>(utf8[i++]);
    if (first < 0x80) {
      text += first < 0x20 || first == 0x7f ? ' ' : static_cast<char>(first);
      continue;
    }
    std::uint32_t code = first & (first >= 0xf0 ? 0x07u : first >= 0xe0 ? 0x0fu : 0x1fu);
    while (i < utf8.size() && (utf8[i] & 0xc0) == 0x80)
      code = code << 6 | (static_cast<unsigned char>(utf8[i++]) & 0x3fu);
    const bool is_wide = code > 0xffff;
    (text += directive) += is_wide ? "X4" : "X2";
    text += directive;
    for (int shift = is_wide ? 28 : 12; shift >= 0; shift -= 4) text += "0123456789ABCDEF"[code >> shift & 0xf];
    ((text += directive) += "X0") += directive;
  }
  return text;
}

/// Names of faces and of what they bound, as the STEP entities that they became have them.
void set_names(const BoundaryModel& model, const ModelShape& made, const STEPControl_Writer& writer) {
  const Handle(Transfer_FinderProcess) found = writer.WS()->TransferWriter()->FinderProcess();
  const auto set = [&](const TopoDS_Shape& shape, const std::string& name) {
    if (name.empty()) return;
    const Handle(StepRepr_RepresentationItem) item = STEPConstruct::FindEntity(found, shape);
    if (!item.IsNull()) item->SetName(new TCollection_HAsciiString(step_string(name).c_str()));
  };
  for (const ModelShape::Part& part : made.parts) set(part.shape, part.name);
  for (size_t f = 0; f < model.faces.size(); ++f) set(made.faces[f], model.faces[f].name);
}

/// Colours of faces, as styles of their STEP entities: a list of them for each part.
void set_colours(const BoundaryModel& model, const ModelShape& made, const STEPControl_Writer& writer) {
  if (std::ranges::none_of(model.faces, [](const SplineFace& face) { return face.colour.has_value(); })) return;
  const Handle(Transfer_FinderProcess) found = writer.WS()->TransferWriter()->FinderProcess();
  TopTools_DataMapOfShapeInteger numbers;
  for (size_t f = 0; f < model.faces.size(); ++f) numbers.Bind(made.faces[f], static_cast<int>(f));
  STEPConstruct_DataMapOfAsciiStringTransient encoded_names;
  STEPConstruct_DataMapOfPointTransient encoded_numbers;
  std::map<std::array<double, 3>, Handle(StepVisual_PresentationStyleAssignment)> assignments;
  for (const ModelShape::Part& part : made.parts) {
    STEPConstruct_Styles styles(writer.WS());
    for (TopExp_Explorer at(part.shape, TopAbs_FACE); at.More(); at.Next()) {
      const int* const number = numbers.Seek(at.Current());
      if (!number || !model.faces[static_cast<size_t>(*number)].colour) continue;
      const std::array<double, 3>& colour = *model.faces[static_cast<size_t>(*number)].colour;
      const Handle(StepRepr_RepresentationItem) item = STEPConstruct::FindEntity(found, at.Current());
      if (item.IsNull()) throw Refused{"it has no entity for a face with a colour"};
      Handle(StepVisual_PresentationStyleAssignment)& assignment = assignments[colour];
      if (assignment.IsNull()) {
        const Quantity_Color color(colour[0], colour[1], colour[2], Quantity_TOC_sRGB);
        assignment = styles.MakeColorPSA(item, STEPConstruct_Styles::EncodeColor(color, encoded_names, encoded_numbers),
                                         {}, {}, 0);
      }
      styles.AddStyle(item, assignment, {});
    }
    if (styles.NbStyles() == 0) continue;
    const Handle(StepRepr_RepresentationContext) context = styles.FindContext(part.shape);
    Handle(StepVisual_MechanicalDesignGeometricPresentationRepresentation) list;
    if (context.IsNull() || !styles.CreateMDGPR(context, list)) throw Refused{"it could not make the colours of faces"};
    writer.WS()->Model()->AddWithRefs(list);
  }
}

std::string step_text(const BoundaryModel& source, const ModelShape& made, const std::string& name) {
  // The unit that a writer finds when it is made scales numbers, the one that it finds when it writes is told in the
  // file.
  Interface_Static::SetCVal("write.step.unit", "MM");
  STEPControl_Writer writer;
  Interface_Static::SetIVal("write.surfacecurve.mode", 0);  // readers find curves in parameters again: lines
  Interface_Static::SetCVal("write.step.product.name", step_string(name).c_str());
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  const char* const units[] = {"MM", "M", "INCH"};  // of LengthUnit
  Interface_Static::SetCVal("write.step.unit", units[static_cast<int>(source.unit)]);
  if (writer.Transfer(made.shape, STEPControl_AsIs) != IFSelect_RetDone)
    throw Refused{"it could not make a STEP model of the surface"};
  set_names(source, made, writer);
  set_colours(source, made, writer);
  const Handle(StepData_StepModel) model = writer.Model();
  APIHeaderSection_MakeHeader header(model);
  header.SetName(new TCollection_HAsciiString(step_string(name).c_str()));
  header.SetTimeStamp(new TCollection_HAsciiString("1970-01-01T00:00:00"));  // equal input, equal bytes
  header.SetAuthorValue(1, new TCollection_HAsciiString(""));
  header.SetOriginatingSystem(new TCollection_HAsciiString("sublimit"));
  header.Apply(model);
  StepData_StepWriter text(model);
  text.FloatWriter().SetFormat("%.16E");  // OpenCASCADE's own has 13 digits
  text.SendModel(Handle(StepData_Protocol)::DownCast(writer.WS()->Protocol()));
  std::ostringstream out;
  if (!text.Print(out) || !out) throw Refused{"it could not print the STEP model"};
  std::string bytes = out.str();
  std::ranges::replace(bytes, directive, '\\');
  return bytes;
}

/// @throws Refused, std::bad_alloc
CadFile made_file(const BoundaryModel& model, const std::string& name, bool step) {
  try {
    Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
    const ModelShape made = shape_of(model);
    CadFile file{{}, made.solids, made.shells, made.volume, made.is_valid};
    if (step) {
      file.bytes = step_text(model, made, name);
    } else {
      std::ostringstream out;
      BRepTools::Write(made.shape, out);
      if (!out) throw Refused{"it could not print the shape"};
      file.bytes = out.str();
    }
    return file;
  } catch (const Standard_OutOfMemory&) {
    throw std::bad_alloc();
  } catch (const Standard_Failure& failure) {
    throw Refused{failure.GetMessageString()};
  }
}

/// OpenCASCADE takes memory in destructors too: where there is none while an error is on its way they throw.
bool is_lack_of_memory() {
  try {
    throw;
  } catch (const Standard_OutOfMemory&) {
    return true;
  } catch (...) {
    return false;
  }
}

}  // namespace

CadFile cad_file(const BoundaryModel& model, const std::string& name, bool step) {
  static std::mutex one_at_a_time;  // its settings are the program's
  const std::lock_guard lock(one_at_a_time);
  const TerminateAsBadAlloc<is_lack_of_memory> named;
  // Inside OpenCASCADE a lack of memory may be caught and told as another failure, or as a shape that is not valid.
  // Made once more, what it really refuses it refuses again; where memory is lacking still, it says so somewhere.
  try {
    CadFile file = made_file(model, name, step);
    if (file.is_valid) return file;
  } catch (const Refused&) {
  }
  try {
    return made_file(model, name, step);
  } catch (const Refused& refused) {
    throw InvalidMesh("OpenCASCADE does not take the surface: " + refused.why +
                      "; edges and faces below 1e-7 in size, and faces that fold, are what it may refuse");
  }
}

}  // namespace sublimit
