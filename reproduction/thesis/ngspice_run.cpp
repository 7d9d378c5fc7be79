#include "reproduction/thesis/ngspice_run.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/text/ascii_text.hpp"
#include "core/text/printable.hpp"
#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

/// A new folder, removed with its files at the end.
class ScratchFolder {
    fs::path path_;

public:
    ScratchFolder() {
        auto name = (fs::temp_directory_path() / "corpuscle-study-XXXXXX").string();
        if (::mkdtemp(name.data()) != nullptr) path_ = name;
    }
    ~ScratchFolder() {
        std::error_code failure;
        if (!path_.empty()) fs::remove_all(path_, failure);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    const fs::path& path() const { return path_; }
};

/// Runs `ngspice -b deck` with its output in the file `log`.
Result<void> run_ngspice(const std::string& deck, const std::string& log) {
    posix_spawn_file_actions_t files;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&files, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::posix_spawn_file_actions_adddup2(&files, 1, 2);
    // BSIM3 writes a log into its folder, so that must be the scratch folder.
    ::posix_spawn_file_actions_addchdir_np(&files, std::filesystem::path(log).parent_path().c_str());
    std::string words[] = {"ngspice", "-b", deck}, one_thread = "OMP_NUM_THREADS=1";  // more threads only wait for one another here
    std::vector<char*> environment{one_thread.data()};
    for (char** entry = environ; *entry != nullptr; ++entry)
        if (!std::string_view(*entry).starts_with("OMP_NUM_THREADS=")) environment.push_back(*entry);
    environment.push_back(nullptr);
    char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
    pid_t process = -1;
    const int failure = ::posix_spawnp(&process, "ngspice", &files, nullptr, arguments, environment.data());
    ::posix_spawn_file_actions_destroy(&files);
    if (failure != 0) return bad_input("ngspice cannot be started; install it: apt-get install ngspice");
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return {};
}

/// The numbers in lines "name = value" of a log.
std::map<std::string, double> numbers_in(std::istream& log) {
    std::map<std::string, double> out;
    std::string line;
    while (std::getline(log, line)) {
        std::istringstream words(line);
        std::string name, equals, text;
        if (!(words >> name >> equals >> text) || equals != "=") continue;
        if (const auto value = parse_bare_number<double>(text)) out.try_emplace(name, *value);
    }
    return out;
}

/// The last lines of a file that name an error.
std::string errors_in(const std::string& path) {
    std::ifstream log(path);
    std::string out, line;
    while (std::getline(log, line))
        if (lower(line).find("error") != std::string::npos && out.size() < 400) out += (out.empty() ? "" : "; ") + printable(line);
    return out.empty() ? "it measured nothing" : out;
}

}  // namespace

Result<std::map<std::string, double>> measure_in_ngspice(const std::string& name, const circuit::Kit& kit) {
    const auto netlist = TRY(elaborate_study_netlist({.circuit = name}));
    const auto deck = TRY(circuit::ngspice_deck(netlist, &kit));
    const ScratchFolder folder;
    if (folder.path().empty()) return bad_input("no folder can be made for the deck of ngspice; set TMPDIR to one that is writable");
    const auto path = (folder.path() / "deck.cir").string(), log = (folder.path() / "log").string();
    std::ofstream(path) << deck.text;
    TRY(run_ngspice(path, log));
    std::ifstream text(log);
    auto out = numbers_in(text);
    if (out.empty()) return bad_input(fmt::format("ngspice, {}: {}", name, errors_in(log)));
    return out;
}

}  // namespace corpuscle
