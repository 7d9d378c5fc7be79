#pragma once
// Arrays as they lie on the chip: their channels in the rectangle that is counted as their total area.

#include "study/thesis/arrays.hpp"

namespace corpuscle {

/// One beside the other, in um.
Plot layout_of(const OurArrays&, std::string title);

/// All of a figure: each array's areas beside the printed ones, and the drawing; `remark` is what is off and why.
Result<Outcome> tell_layout(const PrintedArrays&, const std::string& figure, const std::string& remark);

}  // namespace corpuscle
