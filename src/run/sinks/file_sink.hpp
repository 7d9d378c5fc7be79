#pragma once
// Sinks that write files, and the description of an output format. The list of all formats is run/sinks.cpp.

#include <fmt/format.h>
#include <map>
#include <memory>

#include "io/output/output_file.hpp"
#include "model/copies.hpp"
#include "run/sink.hpp"

namespace corpuscle {

class SkinSummary;
class TrialCollector;

/// The files that the user requests, and the properties of the run that are known before it starts.
struct OutputRequest {
    std::string directory = {};
    std::map<std::string, std::string, std::less<>> options = {};  ///< the output options of the user with their values; "" for a flag
    std::size_t inputs = 1;                                        ///< number of inputs
    std::size_t channels = 1;                                      ///< on channels: number of channels of all inputs
    std::span<const AfferentPlan> plans = {};                      ///< on channels: the simulated afferents
    CopySpec copies = {};
    std::vector<std::string> nwb_fields = {};  ///< of --nwb-field
    std::string command = {};                  ///< the command line, without the options that do not change the response
    std::uint64_t seed = 0;                    ///< of all random numbers
    bool sampled = false;                      ///< spikes have the times of samples
    const SkinSummary* skin = nullptr;         ///< for a skin: its summary, which precedes the files among the sinks
    const TrialCollector* trials = nullptr;    ///< with trials: their responses; it precedes the files among the sinks

    bool has(std::string_view option) const { return options.contains(option); }
};

/// A sink that writes files. The files get their final names in commit().
class FileSink : public Sink {
protected:
    std::string directory_;
    std::vector<OutputFile> files_;  // in the order in which they were created
    /// Creates a file of this name in the directory, as the last of files_.
    Result<void> create(const std::string& name);
    /// Appends the text to the last of files_, and clears it.
    Result<void> write_text(fmt::memory_buffer& text);

public:
    explicit FileSink(const OutputRequest& request) : directory_(request.directory) {}
    FileSink(const FileSink&) = delete;
    FileSink& operator=(const FileSink&) = delete;
    /// Removes the files that were not committed. The last one is removed first: the first one may have created the directory.
    ~FileSink() override;
    /// Creates the files that are needed before begin(). make_file_sink() calls the open() of the derived class.
    Result<void> open() { return {}; }
    virtual std::vector<std::string> paths() const;  ///< final paths of the files
    virtual Result<void> commit();
};

/// A file of spikes, to which the spikes of a block and those after the end of the force are added in the same way.
class SpikeFileSink : public FileSink {
protected:
    using FileSink::FileSink;
    virtual Result<void> add(const Input&, std::span<const Spike>) = 0;

public:
    Result<void> block(const Input& input, const RunBlock& block) override { return add(input, block.spikes); }
    Result<void> end(const Input& input, std::int64_t, std::span<const Spike> last) override { return add(input, last); }
};

/// The largest number of copies of an afferent whose probes or vectors are written.
inline constexpr std::uint32_t max_recorded_copies = 50;

/// An output format. The user requests it by its option.
struct OutputFormat {
    /// Names of the files that it can write. # stands for "" in the name of the first file and "-2" in that of the second; * for any text.
    std::vector<std::string_view> names;
    std::string_view option = {};      ///< "--npz"; "" if it is not requested by an option
    std::string_view value_name = {};  ///< placeholder of the option's value: "TIME"; "" for a flag
    std::string_view help = {};
    Result<std::unique_ptr<FileSink>> (*make)(const OutputRequest&);
    /// For a format without an option: true if it is written.
    bool (*is_written)(const OutputRequest&) = nullptr;
    /// Checks the value of the option, and whether the format can write this run.
    Result<void> (*check)(const OutputRequest&) = [](const OutputRequest&) { return Result<void>{}; };
    /// Names of the files that it writes in this run. Null: the first of `names`, for each input if it contains #.
    std::vector<std::string> (*names_of)(const OutputRequest&) = nullptr;

    std::string_view name() const { return option.empty() ? names[0] : option; }  ///< for messages
};

/// True if the format is written in this run.
bool is_wanted(const OutputFormat&, const OutputRequest&);
/// Names of the files that a format writes in this run.
std::vector<std::string> file_names_of(const OutputFormat&, const OutputRequest&);
/// True if a name of OutputFormat::names stands for this file name.
bool matches_name(std::string_view name, std::string_view file_name);
/// True if the format can write a file of this name.
bool can_write(const OutputFormat&, std::string_view file_name);
/// A name of OutputFormat::names with the number of an input, from 0, instead of #.
std::string numbered_name(std::string_view name, std::size_t index);
/// Returns an error if the run has more copies than max_recorded_copies.
Result<void> check_recorded_copies(const OutputRequest&, std::string_view option);

/// Makes a sink of type F for a request, and creates its first file.
template <class F>
Result<std::unique_ptr<FileSink>> make_file_sink(const OutputRequest& request) {
    auto sink = std::make_unique<F>(request);
    TRY(sink->open());
    return std::unique_ptr<FileSink>(std::move(sink));
}

/// Names of afferent and channel of each afferent of an input as two CSV fields: "sa1,press".
std::vector<std::string> afferent_csv_names(const Population&);

}  // namespace corpuscle
