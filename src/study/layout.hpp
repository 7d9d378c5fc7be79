#pragma once
// Arrays as they lie on the chip: their channels in the rectangle that is counted as their total area.

#include "study/arrays.hpp"

namespace corpuscle {

/// One beside the other, in um.
Plot layout_of(const OurArrays&, std::string title);

}  // namespace corpuscle
