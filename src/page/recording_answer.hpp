#pragma once

#include <optional>

#include "page/kept_recording.hpp"
#include "page/object_reader.hpp"

namespace corpuscle::page {

/// Answers `read`: a recording as force. Its bytes pass through a temporary file, because the readers open paths. `kept` becomes the
/// recording if the request says so; before that, the one that was kept is removed, also if the request then fails.
Result<void> read_recording(ObjectReader&, std::optional<KeptRecording>& kept, MessageWriter& answer);

}  // namespace corpuscle::page
