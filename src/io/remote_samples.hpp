#pragma once
// Samples read by a helper process: the same to whoever fetches them.

#include <functional>

#include "io/samples.hpp"

namespace corpuscle {

/// `open` runs in the child, and so does all that the samples do. `library` is who is to blame, at the start of a sentence.
SamplesResult in_helper_process(const std::string& path, const std::string& library, const std::function<SamplesResult()>& open);

}  // namespace corpuscle
