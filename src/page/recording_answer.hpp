#pragma once

#include "page/object_reader.hpp"

namespace corpuscle::page {

/// Answers `read`: a recording as force. Its bytes pass through a temporary file, because the readers open paths.
Result<void> read_recording(ObjectReader&, MessageWriter& answer);

}  // namespace corpuscle::page
