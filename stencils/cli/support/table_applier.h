// SPDX-License-Identifier: Apache-2.0
#pragma once
// Interface for applying a table to the points of a frame: on the CPU, or on a GPU if the program's GPU part is there.
#include <memory>
#include <span>
#include <string>

#include "sublimit/eval/evaluate/evaluation.h"
#include "sublimit/eval/table/pattern_table.h"

namespace sublimit::cli {

/// A table on some device, with the functions of `PatternEvaluator`.
template <class Real>
class TableApplier {
 public:
  virtual ~TableApplier() = default;
  virtual const PatternTable<Real>& table() const = 0;
  virtual void apply(std::span<const Real> points, int channels, std::span<Real> result) const = 0;
  virtual void apply(const Evaluation<Real>& evaluation) const = 0;
  /// Returns the device as words, "NVIDIA H100, CUDA"; empty for the CPU.
  virtual std::string device() const = 0;
};

/// @param table  must outlive the result, here and below
template <class Real>
std::unique_ptr<TableApplier<Real>> cpu_applier(const PatternTable<Real>& table);
template <class Real>
std::unique_ptr<TableApplier<Real>> cpu_applier(const PatternTable<Real>&&) = delete;

/// @param device  number of the device in `sublimit devices`
/// @throws InvalidOption  no such device; the message has what is missing and an alternative
/// @throws ResourceError  not enough memory on the device
/// @throws IoError        the device was lost
std::unique_ptr<TableApplier<float>> gpu_applier(const PatternTable<float>& table, int device);
std::unique_ptr<TableApplier<float>> gpu_applier(const PatternTable<float>&&, int) = delete;

}  // namespace sublimit::cli
