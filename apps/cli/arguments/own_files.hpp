#pragma once
// Recognises, by its first bytes, a file that an earlier run of the program wrote. Such a file may be replaced without --overwrite. Each
// function is an OutputCheck::Signature for the outputs of one verb.

#include <string_view>

namespace corpuscle {

bool is_own_raw(std::string_view beginning);         ///< .raw of 'run'; the .raw files of ngspice have a date line
bool is_own_table(std::string_view beginning);       ///< CSV of 'run'
bool is_own_events(std::string_view beginning);      ///< spikes of 'stream'
bool is_own_state(std::string_view beginning);       ///< of 'stream --save-state'
bool is_own_checkpoint(std::string_view beginning);  ///< of 'respond --checkpoint'
bool is_own_deck(std::string_view beginning);        ///< ngspice deck of 'export'
bool is_own_markdown(std::string_view beginning);    ///< Markdown of 'study'

}  // namespace corpuscle
