#pragma once

#include "page/message.hpp"

namespace corpuscle::page {

/// Adds the answer of `catalogue`.
void describe_catalogue(MessageWriter& answer);

}  // namespace corpuscle::page
