#include "bindings/bindings.hpp"

namespace corpuscle::python {
namespace {

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// A response from its arrays, for trials.
Response response_of(const Array& times, const py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>& indices,
                     const std::vector<std::string>& names, const std::vector<std::string>& channels, double start, double duration) {
    Response out;
    out.times.assign(times.data(), times.data() + times.size());
    out.indices.assign(indices.data(), indices.data() + indices.size());
    for (std::size_t k = 0; k < names.size(); ++k) out.afferents.push_back({names[k], names[k], channels[k]});
    out.start = start, out.duration = duration;
    return out;
}

py::array copied(const std::vector<double>& values) { return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data()); }

/// The responses as (trial, afferent, times, values).
py::list responses_of(const TrialAnalysis& analysis) {
    py::list out;
    for (const auto& r : analysis.responses) out.append(py::make_tuple(r.trial, r.afferent, copied(r.times), copied(r.values)));
    return out;
}

py::list labels_of(const TrialAnalysis& analysis) {
    py::list out;
    for (const auto& l : analysis.labels)
        out.append(py::make_tuple(l.label, l.afferent, copied(l.mean), copied(l.standard_deviation), l.trials));
    return out;
}

py::list histograms_of(const TrialAnalysis& analysis, double bin) {
    py::list out;
    for (const auto& h : analysis.histograms(bin))
        out.append(py::make_tuple(h.label, h.afferent, copied(h.from), copied(h.to), copied(h.rate), copied(h.standard_error), h.trials, h.spikes));
    return out;
}

}  // namespace

void bind_trials(py::module_& m) {
    py::class_<Epoch>(m, "Epoch")
        .def(py::init<double, double, std::string>())
        .def_readonly("start", &Epoch::start)
        .def_readonly("stop", &Epoch::stop)
        .def_readonly("label", &Epoch::label);
    m.def("read_trial_table", &read_trial_table, py::arg("path"), py::arg("label"));
    m.def("find_contacts",
          [](const py::array_t<double>& force, double rate, double start, std::optional<double> threshold) {
              const auto found = find_force_contacts(view_of_array(force, rate, start, {}, "force"), threshold);
              return py::make_tuple(copied(found.onsets), copied(found.releases), found.level, found.noise, found.threshold, found.release);
          },
          py::arg("force").noconvert(), py::arg("rate"), py::arg("start"), py::arg("threshold"));
    m.def("read_recording_trials", [](const std::string& path, const std::vector<std::string>& by, const std::string& label, const Options& options) {
        std::vector<RecordedTrial> trials;
        {
            py::gil_scoped_release released;
            trials = read_recording_trials(path, by, label, options);
        }
        py::list out;
        for (auto& t : trials) out.append(py::make_tuple(t.label, std::move(t.force)));
        return out;
    });

    py::class_<TrialAnalysis>(m, "TrialAnalysis")
        .def_readonly("trials", &TrialAnalysis::trials)
        .def_readonly("source", &TrialAnalysis::source)
        .def_property_readonly("zero", [](const TrialAnalysis& a) { return copied(a.zero); })
        .def_property_readonly("start", [](const TrialAnalysis& a) { return copied(a.from); })
        .def_property_readonly("stop", [](const TrialAnalysis& a) { return copied(a.to); })
        .def_property_readonly("names", [](const TrialAnalysis& a) {
            std::vector<std::pair<std::string, std::string>> out;
            for (const auto& one : a.afferents) out.emplace_back(one.name, one.channel);
            return out;
        })
        .def_property_readonly("responses", &responses_of)
        .def_property_readonly("labels", &labels_of)
        .def("histograms", &histograms_of);
    // Each source: times, indices, names, channels, start, duration, force or None, rate, trials.
    m.def("analyse_trials", [](const py::list& sources, bool to_onset, std::optional<std::pair<double, double>> window,
                               std::optional<double> threshold) {
        std::vector<Response> responses;
        std::vector<TrialSource> all;
        std::vector<py::array_t<double>> forces;  // keeps the arrays
        responses.reserve(sources.size());
        for (const auto& item : sources) {
            const auto s = item.cast<py::tuple>();
            responses.push_back(response_of(s[0].cast<Array>(), s[1].cast<py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>>(),
                                            s[2].cast<std::vector<std::string>>(), s[3].cast<std::vector<std::string>>(), s[4].cast<double>(),
                                            s[5].cast<double>()));
            TrialSource source{&responses.back(), {}, s[8].cast<std::vector<Epoch>>()};
            if (!s[6].is_none()) {
                forces.push_back(s[6].cast<py::array_t<double>>());
                source.force = view_of_array(forces.back(), s[7].cast<double>(), s[4].cast<double>(), {}, "force");
            }
            all.push_back(std::move(source));
        }
        return analyse_trials(all, {to_onset, window, threshold});
    });
}

}  // namespace corpuscle::python
