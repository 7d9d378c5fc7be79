// Checkpoints of a skin run: arbitrary bytes as FILE, or a real checkpoint with changed bytes and valid checksums, so that its contents are
// read. Expected: the skin resumes and goes on with valid spikes, or there is an error with a message, and both files are unchanged.

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

#include "core/bytes.hpp"
#include "core/number/instruction_set.hpp"
#include "require.hpp"
#include "run/skin/skin_checkpoint.hpp"

using namespace corpuscle;
using fuzz::require;

namespace {

constexpr const char* plan_text = R"(
unit = "mm"
nerve = [0, -150]
[sites]
rows = 2
columns = 2
pitch = 2
[[class]]
afferent = "sa1"
per_site = 1
velocity = "50 m/s"
[[class]]
afferent = "fa2"
per_site = 1
velocity = "50 m/s"
)";
constexpr const char* wave_text = R"(
wave_speed = "10 m/s"
wave_decay = "50 mm"
wave_radius = "1 mm"
wave_gain = 1
wave_corner = "50 Hz"
)";
const RunFingerprint fingerprint = {{"FORCE", "press"}, {"--seed", "0"}};
constexpr std::size_t header_size = 23;  // of both files: "corpuscle checkpoint 2\n", and 24 bytes of FILE.spikes

template <class T>
T value_or_abort(Result<T> result) {
    require(static_cast<bool>(result));
    return std::move(*result);
}

/// One of two skins: without and with a contact wave.
std::unique_ptr<Skin> make_skin(bool has_wave) {
    static const auto make = [](const std::string& text) {
        return value_or_abort(innervate(value_or_abort(parse_skin_plan(text, "fuzz.toml"))));
    };
    static const std::shared_ptr<const Innervation> skins[] = {make(plan_text), make(std::string(plan_text) + wave_text)};
    return value_or_abort(Skin::make(skins[has_wave], {1e-3}, *instruction_set()));
}

/// Simulates 40 samples of a force that grows to 4 N at all sites.
Result<std::vector<Spike>> simulate(Skin& skin) {
    static ThreadPool pool(1);
    constexpr std::size_t steps = 40;
    std::vector<double> force(skin.sites() * steps);
    for (std::size_t k = 0; k < force.size(); ++k) force[k] = 0.1 * static_cast<double>(k % steps);
    std::vector<Spike> spikes;
    TRY(skin.respond({.data = force.data(), .stride = steps}, steps, spikes, pool));
    return spikes;
}

std::string read(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, std::string_view text) {
    std::ofstream(path, std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()));
}

struct Files {
    std::string file, spikes;
};

const std::filesystem::path& folder() {
    static const std::filesystem::path path = "/tmp/corpuscle-fuzz-checkpoint-" + std::to_string(::getpid());
    static const bool once = [] {
        std::filesystem::create_directory(path);
        return std::atexit([] { std::filesystem::remove_all(path); });
    }();
    (void)once;
    return path;
}

/// The files of a run after 40 samples, with spikes that have arrived and others in transit.
Files make_files(bool has_wave) {
    const auto skin = make_skin(has_wave);
    auto checkpoint = value_or_abort(SkinCheckpoint::open(folder() / "made", *skin, fingerprint));
    const auto spikes = value_or_abort(simulate(*skin));
    require(!spikes.empty() && static_cast<bool>(checkpoint->append(spikes)) && static_cast<bool>(checkpoint->flush()));
    Files out{read(folder() / "made"), read(folder() / "made.spikes")};
    checkpoint->remove_files();
    return out;
}

std::string with_checksum(std::string text) {
    const auto sum = checksum_of(std::as_bytes(std::span(text)));
    return text.append(reinterpret_cast<const char*>(&sum), sizeof sum);
}

/// A change of a byte: four bytes of the input are its part of the checkpoint, its position (two) and its new value.
void change(std::string& bytes, std::span<const std::uint8_t, 4> patch) {
    const auto at = static_cast<std::size_t>(patch[1] | patch[2] << 8);
    if (at < bytes.size()) bytes[at] = static_cast<char>(patch[3]);
    if (at == 0xffff && !bytes.empty()) bytes.resize(bytes.size() - std::min<std::size_t>(bytes.size(), patch[3]));
}

/// A real checkpoint with changes of the fingerprint, the number of spikes, the state and the spikes, and then with valid checksums.
Files changed_files(bool has_wave, std::span<const std::uint8_t> patches) {
    static const Files of_skins[] = {make_files(false), make_files(true)};
    const auto& made = of_skins[has_wave];
    ByteReader in(std::string_view(made.file).substr(header_size));
    RunFingerprint run;
    std::uint64_t force_sum = 0, count = 0, spikes_sum = 0;
    std::vector<char> packed;
    require(in.get(run, force_sum, count, spikes_sum, packed));
    std::string state(packed.begin(), packed.end() - 8), spikes = made.spikes;
    std::string numbers(reinterpret_cast<const char*>(&count), sizeof count);
    for (; patches.size() >= 4; patches = patches.subspan(4)) {
        std::string* const parts[] = {&state, &spikes, &numbers, &run[0].second};
        change(*parts[patches[0] % 4], patches.first<4>());
    }
    numbers.resize(sizeof count), std::copy(numbers.begin(), numbers.end(), reinterpret_cast<char*>(&count));
    state = with_checksum(state);
    ByteWriter<std::string> out;
    out.put_raw(made.file.data(), header_size);
    const auto used = std::min<std::uint64_t>(count, spikes.size()) * 24;
    Checksum sum;
    if (spikes.size() > 24) sum.add(spikes.data() + 24, std::min<std::size_t>(used, spikes.size() - 24));
    out.put(run, force_sum, count, sum.value(), std::vector<char>(state.begin(), state.end()));
    return {with_checksum(out.take()), spikes};
}

/// True for spikes in order, of afferents that exist, before sample `end`.
bool are_valid(std::span<const Spike> spikes, const Skin& skin, std::int64_t end) {
    return std::is_sorted(spikes.begin(), spikes.end()) && std::all_of(spikes.begin(), spikes.end(), [&](const Spike& s) {
               return s.afferent_index < skin.innervation().afferents.size() && s.step < end;
           });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 1) return 0;
    const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
    const bool has_wave = data[0] / 3 % 2 == 1;
    Files files = changed_files(has_wave, {});
    if (data[0] % 3 == 0) files.file = rest;
    if (data[0] % 3 == 1) files.file = with_checksum(std::string(rest));
    if (data[0] % 3 == 2) files = changed_files(has_wave, {data + 1, size - 1});
    const auto path = folder() / "state", spikes_path = folder() / "state.spikes";
    write(path, files.file), write(spikes_path, files.spikes);
    const auto skin = make_skin(has_wave);
    const auto checkpoint = SkinCheckpoint::open(path, *skin, fingerprint);
    if (!checkpoint) {
        require(data[0] % 3 != 2 || size > 4);  // a real checkpoint without a change is accepted
        require(!checkpoint.error().message.empty() && checkpoint.error().location.file.starts_with(path.string()));
        return require(read(path) == files.file && read(spikes_path) == files.spikes), 0;
    }
    const auto step = skin->step();
    require((*checkpoint)->resumed_samples() == step && step >= 0);
    std::vector<Spike> replayed;
    require(static_cast<bool>((*checkpoint)->replay(std::numeric_limits<std::int64_t>::max(), replayed)));
    require(are_valid(replayed, *skin, step));
    const auto more = simulate(*skin);
    if (!more) return require(!more.error().message.empty()), 0;
    require(skin->step() == step + 40 && are_valid(*more, *skin, skin->step()));
    return 0;
}
