// The refusal of files that the page cannot read: compressed files, whose libraries emscripten does not have, and the formats of helper
// programs, because a page starts no programs.

#include <fmt/format.h>

#include "circuit/solve/pencil.hpp"
#include "io/sandbox/helper_process.hpp"
#include "io/table/archive.hpp"
#include "io/text/gzip_text.hpp"
#include "page/save/saved_spikes.hpp"

namespace corpuscle {
namespace {

class RefusedGzipText final : public TextInput {
    std::string path_;

    Result<std::size_t> fetch(char*, std::size_t) override {
        return bad_input("the page cannot read gzip files; decompress it first, or use `corpuscle respond`", {path_});
    }
    Result<void> restart() override { return {}; }

public:
    explicit RefusedGzipText(std::string path) : path_(std::move(path)) {}
    double progress() const override { return 0; }
};

Error zip_refusal(const std::string& path) {
    return bad_input("the page cannot read zip archives; extract the file first, or use `corpuscle respond`", {path});
}

}  // namespace

std::unique_ptr<TextInput> make_gzip_text(std::string path, std::unique_ptr<TextInput>) {
    return std::make_unique<RefusedGzipText>(std::move(path));
}

bool Archive::is_supported() { return false; }
Result<Archive> Archive::open(const std::string& path) { return zip_refusal(path); }
Result<std::unique_ptr<SeekableBytes>> Archive::bytes(std::size_t, std::string name) const { return zip_refusal(name); }
Result<std::string> make_archive(const std::vector<ArchiveEntry>&) { return zip_refusal("the archive"); }

// No helper program is found, so none is started.
Result<std::string> find_helper_program(const std::string& name) {
    return bad_input(
        fmt::format("the page cannot read files that need the program {}, such as HDF5, NWB and sound; use `corpuscle respond`", name));
}
HelperProcess::HelperProcess(HelperProcess&&) noexcept = default;
HelperProcess& HelperProcess::operator=(HelperProcess&&) noexcept = default;
HelperProcess::~HelperProcess() = default;
Result<HelperProcess> HelperProcess::start(const std::string& program, int, const std::string&) {
    return find_helper_program(program).error();
}
Result<std::string> HelperProcess::receive(const std::string&, const std::string&) { return find_helper_program(program_).error(); }
bool send_message(int, const std::string&) { return false; }
bool receive_message(int, std::string&) { return false; }

Result<std::vector<std::complex<double>>> circuit::finite_eigenvalues(const Pencil&) {
    return bad_input("the page has no pole-zero analysis; use `corpuscle run`");
}

Result<std::string> page::spikes_nwb(const SavedSpikes&, const SavedForce&) {
    return bad_input("the page cannot write NWB; save CSV, or use the page of `corpuscle stream --serve`");
}

}  // namespace corpuscle
