#pragma once
// Writes an NWB 2 file (Neurodata Without Borders): spike trains as /units, force as TimeSeries, trials as /intervals/trials. The bytes
// depend only on the contents: identifiers are computed from them.

#include <optional>

#include "core/checksum.hpp"
#include "io/hdf5/hdf5_writer.hpp"
#include "io/nwb/nwb_messages.hpp"
#include "io/nwb/nwb_metadata.hpp"

namespace corpuscle {

/// The force of a recording or stimulus, evenly sampled.
struct NwbSeries {
    std::string name;  ///< without '/'
    std::string description;
    bool is_measured = false;           ///< true: under /acquisition; false: under /stimulus/presentation
    std::vector<std::string> channels;  ///< their names
    double start = 0, rate = 1;         ///< s, time of the first sample; Hz
};

/// A column of units: texts or numbers, one for each unit. One of the lists is empty.
struct NwbColumn {
    std::string name, description;
    std::vector<std::string> texts{};
    std::vector<double> numbers{};
};

/// The spike trains of all units.
struct NwbUnits {
    std::string description;
    std::vector<std::vector<double>> trains;  ///< s; strictly ascending, within the observed interval
    double from = 0, to = 0;                  ///< s, the observed interval
    double resolution = 1e-9;                 ///< s, the smallest difference between spike times that has a meaning
    std::vector<NwbColumn> columns;           ///< "afferent" and "channel" among them, which name the units in messages
};

class NwbFile {
    OutputFile file_;
    Hdf5Writer writer_;
    NwbMetadata metadata_;
    std::vector<std::string> typed_;  // paths of objects that get an object_id
    std::string force_path_;          // of the data of the series
    std::uint64_t columns_ = 0;
    Checksum contents_;

    NwbFile(OutputFile file, Hdf5Writer writer, NwbMetadata metadata)
        : file_(std::move(file)), writer_(std::move(writer)), metadata_(std::move(metadata)) {}
    void add_typed(const std::string& path, std::string_view type, std::vector<Hdf5Attribute> = {});
    void add_column(const std::string& path, const NwbColumn&);
    void add_index(const std::string& path, const std::string& target, std::span<const std::uint64_t> ends);
    void add_ids(const std::string& path, std::size_t count);
    void add_spike_times(const NwbUnits&);
    void add_general();
    std::string identifier_of(std::string_view object) const;

public:
    static Result<NwbFile> create(const std::string& path, NwbMetadata);
    const std::string& path() const { return file_.path(); }

    /// The session_description if the metadata have none.
    void set_default_description(const std::string& text) {
        if (metadata_.session_description.empty()) metadata_.session_description = text;
    }

    /// Adds the force, whose samples follow with append_force(). Call it at most once. A name that NWB does not allow is changed.
    void add_force(const NwbSeries&);
    /// Appends samples: for each, the force on all channels, N.
    void append_force(std::span<const double> samples);
    /// Adds the units. Returns an error for trains that NWB does not allow; see NwbUnits.
    Result<void> add_units(const NwbUnits&);
    /// Adds the trials. Returns an error for a trial that does not end after it begins.
    Result<void> add_trials(std::span<const NwbTrial>);
    /// `source`: how the file was made, such as the command line; "": unknown. `notes`: more about it.
    void add_provenance(const std::string& source, const std::string& notes);
    /// Completes the file and gives it its final name.
    Result<void> commit();
};

}  // namespace corpuscle
