#pragma once

#include "fit/transistor/transistor_fit.hpp"

namespace corpuscle {

/// The page of a fitted transistor as self-contained HTML: values, measured and computed curves, and their differences.
std::string transistor_page(const TransistorFit&, const IvData&, const std::string& command);

}  // namespace corpuscle
