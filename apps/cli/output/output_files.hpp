#pragma once
// Output files: writing a complete file, and recognising the files of earlier runs.

#include "io/output/output_file.hpp"

namespace corpuscle {

/// Writes the complete content of a file and renames the file to its final name.
Result<void> write_and_commit(OutputFile&, const std::string& text);
Result<void> write_file(const std::string& path, const std::string& text);

// Recognises, by its first bytes, a file that an earlier run of the program wrote. Such a file may be replaced without --overwrite. Each
// function is an OutputCheck::Signature for the outputs of one verb.
bool is_own_raw(std::string_view beginning);         ///< .raw of 'run'; those of ngspice name no writer
bool is_own_table(std::string_view beginning);       ///< CSV of 'run'
bool is_own_events(std::string_view beginning);      ///< spikes of 'stream'
bool is_own_state(std::string_view beginning);       ///< of 'stream --save-state'
bool is_own_checkpoint(std::string_view beginning);  ///< of 'respond --checkpoint'
bool is_own_markdown(std::string_view beginning);    ///< Markdown of 'study'

}  // namespace corpuscle
