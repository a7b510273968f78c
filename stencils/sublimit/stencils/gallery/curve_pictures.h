// SPDX-License-Identifier: Apache-2.0
#pragma once
// The curves of the gallery: an open and a closed polygon under every curve scheme, level by level.
#include "sublimit/stencils/gallery/gallery_part.h"

namespace sublimit::gallery {

/// Returns a section for each polygon, with a row for each scheme, and the rows' pictures.
/// @param levels  number of levels drawn after the control polygon
GalleryPart curve_pictures(int levels);

}  // namespace sublimit::gallery
