// A press on an electronic skin of 21 optical sensors. Its authors recorded it together with the spikes of their network of 900 neurons and
// of their haptic display (its motors). The same press is applied to a sheet of our afferents, and the times and places of the spikes are
// compared.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "io/recording/recording.hpp"
#include "io/spikes/spike_files.hpp"
#include "reproduction/claims/check_all.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/skin/afferent_sheet.hpp"

namespace corpuscle::studies::eskin_press {

constexpr const char* folder = "fbg_eskin_press";
constexpr double rate = 100.04;  // Hz, the mean sample rate; the recording's timestamps are arrival times, in bursts
constexpr double scale = 40;     // N/nm; our choice, as none is published; the largest force is then 8.9 N (doc/real-recordings.md)
constexpr double sigma = 20e-3;  // m, of the afferents' receptive fields: the spacing of sensors in a row; our choice
constexpr double from = 17.3, to = 21.1, bin = 0.1;  // s, recording's clock: while the skin is pressed, without onset and release
constexpr double arrival_gap = 0.163;                // s, the longest gap between two timestamps

/// Spike counts of the neurons that fired, by neuron number.
using Counts = std::map<std::size_t, double>;

struct Published {
    std::vector<SheetSpike> network;                    ///< in order of time; afferent_index: the published neuron number - 1
    std::map<std::string, std::vector<double>> motors;  ///< spike times (s) of each motor of the display, by its name
};

Counts counts_of(const std::vector<SheetSpike>& spikes) {
    Counts out;
    for (const auto& s : spikes) out[s.afferent_index] += 1;
    return out;
}

/// The sensors' force and positions. `layout` is the file of the positions.
Result<SheetForce> read_force(const std::string& path, const std::string& layout) {
    auto source = TRY(open_recording(path, {.rate = rate, .scale = scale, .layout = layout}));
    SheetForce out{source->clock().T(), {}, {}};
    for (const auto& c : source->channels()) out.positions.push_back({c.position->x * 1e-3, c.position->y * 1e-3});  // mm to m
    out.force.resize(out.positions.size());
    for (Frames block(out.positions.size(), 1024);;) {
        TRY(source->read(block));
        if (block.count == 0) return out;
        for (std::size_t s = 0; s < out.positions.size(); ++s)  // negative readings are taken as 0
            for (std::size_t k = 0; k < block.count; ++k) out.force[s].push_back(std::max(0.0, block.force[s][k]));
    }
}

Result<Published> read_published(const std::string& from_folder) {
    Published out;
    const auto network = read_spikes(from_folder + "/snn_spikes_S6_T16.csv"),
               motors = read_spikes(from_folder + "/motor_spikes_S6_T16.csv");
    TRY(check_all(network, motors));
    for (const auto& train : *network)
        for (const double t : train.times) out.network.push_back({t, std::stoul(train.afferent) - 1});
    std::sort(out.network.begin(), out.network.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
    for (const auto& train : *motors) out.motors[train.afferent] = train.times;
    return out;
}

/// Root mean square distance of the neurons that fired from their centre, in neurons, if the neurons are numbered row by row on a sheet
/// with this number of columns.
double extent(const Counts& counts, std::size_t columns) {
    double n = 0, row_sum = 0, c = 0, square = 0;
    const auto row = [&](std::size_t u) { return static_cast<double>(u / columns); };
    const auto column = [&](std::size_t u) { return static_cast<double>(u % columns); };
    for (const auto& [u, _] : counts) n += 1, row_sum += row(u), c += column(u);
    for (const auto& [u, _] : counts) square += (row(u) - row_sum / n) * (row(u) - row_sum / n) + (column(u) - c / n) * (column(u) - c / n);
    return std::sqrt(square / n);
}

/// The number of columns of the sheet for which the neurons that fired have the smallest extent.
std::size_t columns_of(const Counts& counts) {
    std::size_t best = 2;
    for (std::size_t c = 2; c <= 450; ++c)
        if (extent(counts, c) < extent(counts, best)) best = c;
    return best;
}

/// The neuron with the most spikes.
std::size_t most_active(const Counts& counts) {
    return std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first;
}

/// How much the spike counts differ between the two sides of the row `middle`: half of the sum of |count - count of the mirrored neuron|
/// over the neurons that fired, as a fraction of all spikes. A mirrored neuron that is silent or outside the sheet has the count 0.
double asymmetry(const Counts& counts, std::size_t columns, std::size_t middle) {
    double difference = 0, total = 0;
    for (const auto& [u, n] : counts) {
        const std::size_t row = u / columns, mirrored = (2 * middle - row) * columns + u % columns;
        const auto other = counts.find(mirrored);
        difference += std::abs(n - (other == counts.end() ? 0 : other->second)), total += n;
    }
    return difference / total / 2;
}

std::vector<double> times_of(const std::vector<SheetSpike>& spikes) {
    std::vector<double> out;
    for (const auto& s : spikes) out.push_back(s.time);
    return out;
}

/// Spike counts of all neurons of the sheet, by number; 0 for those that did not fire.
std::vector<double> dense_counts(const Counts& counts, const AfferentSheet& sheet) {
    std::vector<double> out(sheet.rows * sheet.columns);
    for (const auto& [u, n] : counts)
        if (u < out.size()) out[u] = n;
    return out;
}

/// The first and the last time (s) at which the sensor with the largest force is above a twentieth of its maximum.
std::pair<double, double> press_interval(const SheetForce& force) {
    std::size_t strongest = 0;
    const auto peak_force = [&](std::size_t s) { return *std::max_element(force.force[s].begin(), force.force[s].end()); };
    for (std::size_t s = 0; s < force.positions.size(); ++s)
        if (peak_force(s) > peak_force(strongest)) strongest = s;
    const auto& f = force.force[strongest];
    const auto above = [&](double x) { return x > 0.05 * peak_force(strongest); };
    const auto first = std::find_if(f.begin(), f.end(), above) - f.begin();
    const auto last = f.rend() - std::find_if(f.rbegin(), f.rend(), above) - 1;
    return {force.time(static_cast<std::size_t>(first)), force.time(static_cast<std::size_t>(last))};
}

/// The longest interval between two consecutive spikes, s.
double longest_silence(const std::vector<double>& t) {
    double longest = 0;
    for (std::size_t k = 1; k < t.size(); ++k) longest = std::max(longest, t[k] - t[k - 1]);
    return longest;
}

/// Our sheet with its response to the sensors' force, and the published spikes.
struct Comparison {
    AfferentSheet sheet;
    SheetForce force;
    Published published;
    std::vector<SheetSpike> sa1, fa1;
};

/// How the network's neuron numbers are arranged on a sheet.
void report_numbers(StudyResult& out, const Comparison& a) {
    const auto counts = counts_of(a.published.network);
    const std::size_t columns = columns_of(counts), top = most_active(counts);
    out.claim("network: neurons that fired", static_cast<double>(counts.size()), "neurons")
        .published_as(123, "the recording's README")
        .of_kind(ClaimKind::input);
    out.claim("network: spikes", static_cast<double>(a.published.network.size()), "spikes")
        .published_as(42156, "the recording's README")
        .of_kind(ClaimKind::input);
    out.claim("width of the sheet for which the neurons that fired are closest together", static_cast<double>(columns), "neurons")
        .derived_as(30, "900 neurons are 30 x 30 if the sheet is square, which is not stated")
        .of_kind(ClaimKind::ours);
    out.claim("spread of the neurons that fired, for this width", extent(counts, columns), "neurons");
    out.claim("spread of the neurons that fired, for a sheet two columns narrower", extent(counts, columns - 2), "neurons")
        .allow_min(1.5 * extent(counts, columns), "check: no other width gives a disc")
        .of_kind(ClaimKind::ours);
    out.claim("most active neuron: row, from 0", static_cast<double>(top / columns));
    out.claim("most active neuron: column, from 0", static_cast<double>(top % columns));
    out.claim("difference between the spike counts on either side of the most active neuron's row, over all spikes",
              asymmetry(counts, columns, top / columns))
        .allow_max(0.05, "check: the press is in the middle of the skin's width")
        .of_kind(ClaimKind::ours);
}

/// When the spikes begin and end, relative to the press.
void report_time(StudyResult& out, const Comparison& a) {
    const auto [on, off] = press_interval(a.force);
    const auto add_edge_claims = [&](const char* source, const std::vector<double>& t) {
        if (t.empty()) return;
        out.claim(fmt::format("{}: delay of the first spike after sensor 11 exceeds 5 % of its maximum", source), t.front() - on, "s")
            .allow_range(-arrival_gap, arrival_gap, "the recording's timestamps: gaps of up to 163 ms");
        out.claim(fmt::format("{}: delay of the last spike after sensor 11 falls below 5 % of its maximum", source), t.back() - off, "s")
            .allow_range(-arrival_gap, arrival_gap, "the recording's timestamps: gaps of up to 163 ms");
    };
    out.claim("sensor 11: above a twentieth of its maximum from", on, "s");
    out.claim("sensor 11: above a twentieth of its maximum until", off, "s");
    add_edge_claims("network", times_of(a.published.network));
    std::vector<double> motors;
    for (const auto& [name, t] : a.published.motors) motors.insert(motors.end(), t.begin(), t.end());
    std::sort(motors.begin(), motors.end());
    add_edge_claims("display", motors);
    add_edge_claims("our SA-I", times_of(a.sa1));
    add_edge_claims("our FA-I", times_of(a.fa1));
    const auto fraction_away_from_edges = [&](const std::vector<SheetSpike>& s) {
        double n = 0;
        for (const auto& x : s) n += x.time > on + 0.5 && x.time < off - 0.5;
        return n / static_cast<double>(s.size());
    };
    out.claim("network: longest silence while the skin is pressed", longest_silence(times_of(a.published.network)), "s");
    out.claim("our SA-I: longest silence while the skin is pressed", longest_silence(times_of(a.sa1)), "s");
    out.claim("network: fraction of spikes at least 0.5 s from both edges", fraction_away_from_edges(a.published.network));
    out.claim("our SA-I: fraction of spikes at least 0.5 s from both edges", fraction_away_from_edges(a.sa1))
        .derived_as(fraction_away_from_edges(a.published.network), "the network's");
    out.claim("our FA-I: fraction of spikes at least 0.5 s from both edges", fraction_away_from_edges(a.fa1))
        .allow_max(0.5 * fraction_away_from_edges(a.published.network), "a fast afferent responds at the edges");
}

/// Number of spikes of all motors of the display in each bin.
std::vector<double> display_rate(const Published& published) {
    std::vector<SheetSpike> display_spikes;
    for (const auto& [name, t] : published.motors)
        for (const double x : t) display_spikes.push_back({x, 0});
    return centroid_track(AfferentSheet{}, display_spikes, from, to, bin).weight;
}

/// Where the spikes are, over time, relative to the press.
void report_place(StudyResult& out, const Comparison& a) {
    const auto sensors = centroid_track(a.force, from, to, bin), published = centroid_track(a.sheet, a.published.network, from, to, bin),
               ours = centroid_track(a.sheet, a.sa1, from, to, bin);
    const auto mean = [](const std::vector<double>& v) {
        double n = 0, sum = 0;
        for (const double x : v)
            if (std::isfinite(x)) n += 1, sum += x;
        return sum / n;
    };
    for (const auto& [source, track] :
         {std::pair{"sensors", &sensors}, {"our SA-I", &ours}, {"network, with its neuron numbers on our sheet", &published}}) {
        out.claim(fmt::format("{}: mean position across the skin", source), mean(track->x), "m");
        out.claim(fmt::format("{}: mean position along the skin", source), mean(track->y), "m");
    }
    const auto add_correlation = [&](const char* label, const std::vector<double>& first, const std::vector<double>& second,
                                     double min_r) -> Claim& {
        return out.claim(label, correlation(first, second)).allow_min(min_r, "check: rates follow the position").of_kind(ClaimKind::ours);
    };
    add_correlation("our SA-I follow the sensors across the skin: r", ours.x, sensors.x, 0.8);
    add_correlation("our SA-I follow the sensors along the skin: r", ours.y, sensors.y, 0.8)
        .explain_if_needed(
            "sensors far from the press read 0.1 to 0.2 N, too little for a response of SA-I, but these readings count in the sensors' "
            "mean position");
    add_correlation("the network's row follows the sensors across the skin: r", published.x, sensors.x, 0.5);
    add_correlation("the network's column follows the sensors along the skin: r", published.y, sensors.y, 0.5);
    add_correlation("the network's row and our SA-I across the skin: r", published.x, ours.x, 0.5);
    out.claim("rates of the network and of our SA-I over time: r", correlation(published.weight, ours.weight));
    out.claim("rates of the network and of the display over time: r", correlation(published.weight, display_rate(a.published)));
    const auto network_counts = dense_counts(counts_of(a.published.network), a.sheet), our_counts = dense_counts(counts_of(a.sa1), a.sheet);
    add_correlation("spike counts of 900 neurons, network and our SA-I, compared by number: r", network_counts, our_counts, 0.8);
    StudyPlot across{"Position of the press across the skin", "time (s)", "x (mm)", {}},
        along{"Position of the press along the skin", "time (s)", "y (mm)", {}},
        rates{"Spikes, and sum of the sensors, in 100 ms", "time (s)", "fraction of the largest", {}};
    for (const auto& [source, track] : {std::pair{"sensors", &sensors}, {"our SA-I", &ours}, {"network", &published}}) {
        const double most = *std::max_element(track->weight.begin(), track->weight.end());
        const auto line = [&](const std::vector<double>& v, double times) {
            StudyCurve scaled{track->t, v};
            for (double& y : scaled.y) y *= times;
            return scaled;
        };
        across.add(source, line(track->x, 1e3)), along.add(source, line(track->y, 1e3)), rates.add(source, line(track->weight, 1 / most));
    }
    for (auto* plot : {&across, &along, &rates}) out.plots.push_back(std::move(*plot));
}

Result<StudyResult> compute(const StudyOptions& options) {
    const auto path = TRY(options.recordings_in(folder));
    Comparison a;
    auto force = TRY(read_force(path + "/fbg_press_S6_T16.csv", path + "/sensor_positions.csv"));
    a.force = std::move(force);
    auto published = TRY(read_published(path));
    a.published = std::move(published);
    a.sheet.corner = {-0.5 * static_cast<double>(a.sheet.rows) * a.sheet.pitch, 0};
    for (const auto& [name, spikes] : {std::pair{"sa1", &a.sa1}, {"fa1", &a.fa1}}) {
        *spikes = TRY(simulate_sheet(a.sheet, name, a.force, sigma));
        TRY(options.report_progress(name[0] == 's' ? 0.4 : 0.8));
    }
    StudyResult out;
    report_numbers(out, a);
    report_time(out, a);
    report_place(out, a);
    out.notes = {
        "One press shows this about the network's neuron numbers. In rows of 30 the neurons that fired form one round patch, cut by the "
        "edge of the sheet at column 0. The patch drifts over the rows as the load drifts across the skin, and over the columns as it "
        "drifts along the skin, both towards higher numbers. The spacing of the neurons in millimetres and the origin of the sheet remain "
        "unknown, because only one place was pressed.",
        "Our sheet is also 30 x 30, with a spacing of 4.5 mm (our choice), centred on the skin's width and starting at its origin. These "
        "choices put the network's patch at the place of the press, so only the drift is evidence, not the place.",
        "Times: sensors are sampled at an even 100.04 Hz, because their timestamps are arrival times in bursts; the published spikes use "
        "the timestamps' clock. At the onset the timestamps are 17 ms behind the even clock, elsewhere up to 163 ms. Onset and release are "
        "not known more precisely.",
        "Around 18.15 s of the recording the published network is silent for a while, although the skin is pressed and its frames arrive. "
        "This is the main difference between its rate and that of our SA-I. The display stops as well.",
        "The network has slowly adapting neurons; FA-I fire at the edges only.",
        "Force: 40 N per nanometre, our choice. An afferent's force is the sum over all sensors, each weighted by exp(-d^2 / 2 sigma^2), "
        "with sigma of 20 mm, the spacing of sensors in a row."};
    return out;
}

const Study study{"eskin-press",
                  "A press on an electronic skin, and its authors' network",
                  "Do the rates of a sheet of our afferents follow the pressed place, and when do they begin and end compared with the "
                  "published network's? Neuromorphic-Touch-Sensing-Haptic-Display, data of figure 2",
                  ClaimKind::predicted,
                  compute,
                  folder};

}  // namespace corpuscle::studies::eskin_press
