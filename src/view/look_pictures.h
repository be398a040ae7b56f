// SPDX-License-Identifier: MIT
// What looks.cpp registers: each draws one look of a snapshot that has what it needs.
#pragma once
#include "view/looks.h"

namespace izb::draw {

LookPicture depth(const Snapshot&, int);
LookPicture normal(const Snapshot&, int);
LookPicture shading_normal(const Snapshot&, int);
LookPicture albedo(const Snapshot&, int);
LookPicture triangle(const Snapshot&, int);
LookPicture instance(const Snapshot&, int);
LookPicture light_class(const Snapshot&, int);
LookPicture visibility(const Snapshot&, int);
LookPicture errors(const Snapshot&, int);

LookPicture cascade(const Snapshot&, int);
LookPicture elongation(const Snapshot&, int);
LookPicture footprint(const Snapshot&, int);
LookPicture list_length(const Snapshot&, int);
LookPicture tests(const Snapshot&, int);
LookPicture removed(const Snapshot&, int);

LookPicture grid_lists(const Snapshot&, int layer);
LookPicture grid_zcull(const Snapshot&, int layer);
LookPicture grid_fragments(const Snapshot&, int layer);

/// What is seen, as a dark grey background without shadows' contrast.
float dim_grey(const Snapshot& snapshot, size_t i);

}  // namespace izb::draw
