#pragma once
// Reads the values of a population file: numbers with their units and ranges, positions, sites and classes.

#include "core/text/config_file.hpp"
#include "skin/plan/skin_plan.hpp"

namespace corpuscle::skins {

/// Every physical quantity in a population file must have a unit. Only a length may omit it, if the file defines a unit of length at its
/// top.
class PopulationValues {
    std::optional<double> metres_;  // the file's unit of length in metres; not set if the file defines none

public:
    /// For the outermost table of a file.
    static Result<PopulationValues> of(const ConfigNode& top);

    /// The value of a number in SI. `name` is its key, `unit` the SI unit of the quantity. A value outside [low, high] (SI) is an error.
    Result<double> number(const LocatedText&, std::string_view name, std::string_view unit, double low, double high) const;
    /// The same for a key of a table; 0 if it is missing.
    Result<double> number_of(const ConfigNode& table, std::string_view name, std::string_view unit, double low, double high) const;
    /// The same for an integer, which is `fallback` if it is missing.
    Result<std::uint64_t> integer(const ConfigNode& table, std::string_view name, std::uint64_t low, std::uint64_t high,
                                  std::uint64_t fallback) const;
    /// A position from two lengths. `name`: the key to which it belongs, for messages.
    Result<Position> position(const LocatedText& x, const LocatedText& y, std::string_view name) const;
    /// A position from a list [x, y].
    Result<Position> position(const ConfigNode&, std::string_view name) const;
};

/// The text of a key that must exist. `where` and `example` are for the message.
Result<LocatedText> required_text(const ConfigNode& table, std::string_view name, std::string_view where, std::string_view example);

/// The table `source`: for each of the quantities `known`, where it was published.
Result<std::vector<SourceNote>> read_sources(const ConfigNode& table, std::span<const ConfigKey> known);

/// The sites of a population file, whose outermost table is `top`. `channels`: of the recording.
Result<Sites> read_sites(const ConfigNode& top, std::span<const Channel> channels, const PopulationValues&);

/// How a class responds to tangential force: the keys direction_gain, direction and direction_spread of [[class]].
Result<DirectionTuning> read_direction_tuning(const ConfigNode& in, const PopulationValues&);

/// The classes of a population file whose sites have been read.
Result<std::vector<SkinClass>> read_classes(const ConfigNode& top, const Sites&, const PopulationValues&);

/// The contact wave of a class; without wave_speed, none.
Result<WaveParams> read_wave(const ConfigNode& in, const PopulationValues&);

}  // namespace corpuscle::skins
