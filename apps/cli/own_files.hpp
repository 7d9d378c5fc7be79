#pragma once
// How a file that stands alone is known as one that an earlier run of ours wrote: by its first bytes.

#include <string_view>

namespace corpuscle {

bool is_own_raw(std::string_view beginning);         ///< of 'run': .raw, which ngspice's differs from by its date
bool is_own_table(std::string_view beginning);       ///< of 'run': CSV
bool is_own_events(std::string_view beginning);      ///< of 'stream'
bool is_own_state(std::string_view beginning);       ///< of 'stream --save-state'
bool is_own_checkpoint(std::string_view beginning);  ///< of 'respond --checkpoint'
bool is_own_deck(std::string_view beginning);        ///< of 'export'
bool is_own_markdown(std::string_view beginning);    ///< of 'study'

}  // namespace corpuscle
