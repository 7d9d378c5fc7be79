#include "bindings/background_run.hpp"

namespace corpuscle::python {
namespace {

using Trains = std::vector<SpikeTrain>;

/// Trains from tuples of afferent, channel and an array of times.
Trains trains_from(const py::list& tuples) {
    Trains out;
    for (const auto& item : tuples) {
        const auto fields = item.cast<py::tuple>();
        const auto times = fields[2].cast<py::array_t<double, py::array::c_style | py::array::forcecast>>();
        out.push_back({fields[0].cast<std::string>(), fields[1].cast<std::string>(), {times.data(), times.data() + times.size()}});
    }
    return out;
}

Comparison compare_in_background(ComparisonSettings settings, const py::object& progress,
                                 const std::function<Comparison(const ComparisonSettings&)>& run) {
    return run_in_background(progress, [&](const auto& go_on) {
        settings.progress = go_on;
        return run(settings);
    });
}

py::list rows_of(const Comparison& comparison) {
    py::list out;
    const auto add = [&](const TrainComparison& t) {
        out.append(py::make_tuple(t.a, t.b, t.spikes_a, t.spikes_b, t.matched, t.missing, t.extra, t.max_shift, t.rms_shift,
                                  t.victor_purpura, t.victor_purpura_per_spike, t.van_rossum));
    };
    for (const auto& pair : comparison.pairs) add(pair);
    add(comparison.total);
    return out;
}

}  // namespace

void bind_compare(py::module_& m) {
    py::class_<ComparisonSettings>(m, "ComparisonSettings")
        .def(py::init<>())
        .def_readwrite("pairs", &ComparisonSettings::pairs)
        .def_readwrite("by_order", &ComparisonSettings::by_order)
        .def_readwrite("window", &ComparisonSettings::window)
        .def_readwrite("cost", &ComparisonSettings::cost)
        .def_readwrite("tau", &ComparisonSettings::tau);
    const auto result = [](const Comparison& c) { return py::make_tuple(rows_of(c), c.text, c.document); };
    m.def("compare", [result](const py::list& a, const py::list& b, const ComparisonSettings& settings, const py::object& progress) {
        const auto first = trains_from(a), second = trains_from(b);
        return result(compare_in_background(settings, progress, [&](const ComparisonSettings& s) { return compare(first, second, s); }));
    });
    m.def("compare_files",
          [result](const std::string& a, const std::string& b, const ComparisonSettings& settings, const py::object& progress) {
              return result(compare_in_background(settings, progress, [&](const ComparisonSettings& s) { return compare_files(a, b, s); }));
          });
}

}  // namespace corpuscle::python
