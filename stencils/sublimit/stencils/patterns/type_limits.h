// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits of a type, with statuses and derivatives, evaluated on the limit surface of the type's own points.
#include <memory>
#include <optional>

#include "sublimit/stencils/patterns/patterns.h"

namespace sublimit {

/// Returns limits of points of a lattice; absent if limit masks reach beyond the points of the type.
std::optional<Patterns::LimitBlock> limits_of_type(const std::shared_ptr<LimitCache>& types, const PieceType& type,
                                                   const Patterns::LimitRequest& request);
/// Returns limits at any parameters (u, v) of an address.
/// @param place  position of the type in the address; only its turn and quarter are used
std::optional<Patterns::LimitBlock> limits_of_type(const std::shared_ptr<LimitCache>& types, const PieceType& type,
                                                   const LatticePlace& place,
                                                   std::span<const AddressParameters> parameters, int derivatives);

}  // namespace sublimit
