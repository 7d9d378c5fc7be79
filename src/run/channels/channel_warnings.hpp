#pragma once
// Warnings about a run of afferents on channels.

#include "model/catalog.hpp"
#include "run/run_inputs.hpp"

#include <string>

namespace corpuscle {

/// Warnings about circuits whose chips are all equal although they were requested.
std::vector<std::string> equal_chips_warnings(std::span<const AfferentPlan> afferents);
/// Warnings about afferents that membrane noise does not affect. `noise` in A.
std::vector<std::string> noise_warnings(std::span<const AfferentPlan> afferents, double noise);

/// The warning that a quantity of an afferent was outside its range: "sa1-circuit on press: v(vf) was outside ...". `samples`: number of
/// all samples.
std::string range_warning(const std::string& afferent, const std::string& channel, const ValidRange&, const RangeViolation&,
                          std::int64_t samples, const Clock&);

/// Warnings about the response: truncated steps, saturation, overflow, quantities outside their range, and circuits that did not converge.
std::vector<std::string> response_warnings(const RunStats&);

/// The warning that a sample rate (Hz) is too low for an afferent; "" if it is not. It begins with `subject`, "fa2".
std::string rate_warning(const AfferentPlan&, const std::string& subject, double rate);
/// The same for a source, with the subject "fa2 on press".
std::string source_rate_warning(const AfferentPlan&, const std::string& source, double rate);

/// Warnings, known before the run, about sources with a sample rate that is too low for an afferent.
std::vector<std::string> rate_warnings(std::span<const std::unique_ptr<ForceSource>> sources, std::span<const AfferentPlan> afferents);

/// The highest firing rate of a nerve fibre, Hz. The absolute refractory period is about 1 ms (Hodgkin & Huxley 1952, J Physiol 117:500).
inline constexpr double max_nerve_rate = 1e3;

/// The warning "spikes come at up to 3.1 kHz ...", with advice. `rate`: the highest firing rate of the afferent, Hz. If it is above the
/// sample rate 1 / T (s), the warning does not name it, because two spikes within one sample do not define a rate. If the afferent
/// is refractory for 1 ms or more, the warning asks for faster samples instead. `name`: of the afferent for --set.
std::string excessive_rate_warning(double rate, double T, const AfferentPlan&, const std::string& name);

/// The highest firing rate (Hz) of a train with these values of all `measures`; infinite if several spikes come within one sample (T, s).
double highest_rate(std::vector<double> values, double T);

/// The warning about an afferent that fires faster on a channel than a nerve fibre can, with the names of both; "" if its highest `rate`
/// (Hz) is not too fast.
std::string channel_rate_warning(double rate, double T, const AfferentPlan&, const std::string& channel);

}  // namespace corpuscle
