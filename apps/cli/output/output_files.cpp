#include "cli/output/output_files.hpp"

namespace corpuscle {

Result<void> write_and_commit(OutputFile& file, const std::string& text) {
    TRY(file.write(text));
    TRY(file.commit());
    return file.is_synced() ? sync_directory_of(file.path()) : Result<void>();
}

Result<void> write_file(const std::string& path, const std::string& text) {
    auto file = OutputFile::create(path);
    return file ? write_and_commit(*file, text) : file.error();
}

}  // namespace corpuscle
