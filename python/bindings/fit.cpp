#include "bindings/background_run.hpp"

namespace corpuscle::python {
namespace {

/// One fit: of recordings, or of a table of targets.
struct FitTask {
    std::vector<FitRecording> recordings;
    std::string targets;
    FitOptions options;
};

AfferentFit run_fit(FitTask& task, const py::object& function) {
    return run_in_background(function, [&](const auto& progress) {
        task.options.progress = progress;
        return task.targets.empty() ? fit_afferent(task.recordings, task.options) : fit_targets(task.targets, task.options);
    });
}

}  // namespace

void bind_fit(py::module_& m) {
    py::class_<FittedValue>(m, "FittedValue")
        .def_readonly("name", &FittedValue::name)
        .def_readonly("unit", &FittedValue::unit)
        .def_readonly("start", &FittedValue::start)
        .def_readonly("value", &FittedValue::value)
        .def_readonly("low", &FittedValue::low)
        .def_readonly("high", &FittedValue::high)
        .def_readonly("is_at_bound", &FittedValue::is_at_bound);
    py::class_<AfferentFit>(m, "AfferentFit")
        .def_readonly("afferent", &AfferentFit::afferent)
        .def_readonly("parameters", &AfferentFit::parameters)
        .def_readonly("start_score", &AfferentFit::start_score)
        .def_readonly("score", &AfferentFit::score)
        .def_readonly("test_score", &AfferentFit::test_score)
        .def_readonly("settings", &AfferentFit::settings)
        .def_readonly("is_interrupted", &AfferentFit::is_interrupted)
        .def_readonly("warnings", &AfferentFit::warnings)
        .def_readonly("document", &AfferentFit::document)
        .def_readonly("settings_file", &AfferentFit::settings_file);
    py::class_<FitTask>(m, "FitTask")
        .def(py::init<>())
        .def_readwrite("targets", &FitTask::targets)
        .def("set_options",
             [](FitTask& task, std::string afferent, std::vector<std::string> free, std::vector<std::string> bounds,
                std::vector<std::string> settings, double tau, double delay, double hold_out, double rate) {
                 auto& o = task.options;
                 o.afferent = std::move(afferent), o.free = std::move(free), o.bounds = std::move(bounds);
                 o.settings = std::move(settings), o.tau = tau, o.delay = delay, o.hold_out = hold_out, o.rate = rate;
             })
        .def("set_search",
             [](FitTask& task, std::uint32_t points, std::uint32_t starts, std::uint32_t evaluations, std::uint64_t seed, unsigned threads) {
                 auto& o = task.options;
                 o.points = points, o.starts = starts, o.evaluations = evaluations, o.seed = seed, o.threads = threads;
             })
        .def("add",  // the caller keeps the array until the fit is done
             [](FitTask& task, const py::array_t<double>& force, double rate, double start, std::vector<std::string> channels,
                std::string name, std::vector<std::vector<double>> trains, std::string spike_file) {
                 task.recordings.push_back({view_of_array(force, rate, start, std::move(channels), std::move(name)), std::move(trains),
                                            std::move(spike_file)});
             },
             py::arg("force").noconvert(), py::arg("rate"), py::arg("start"), py::arg("channels"), py::arg("name"), py::arg("trains"),
             py::arg("spike_file"), py::keep_alive<1, 2>())
        .def("run", &run_fit);
    m.def("read_spike_trains", [](const std::string& path, const std::string& time, const std::string& train) {
        std::vector<SpikeTrain> trains;
        {
            py::gil_scoped_release released;
            trains = read_spike_trains(path, time, train);
        }
        py::list out;
        for (const auto& t : trains)
            out.append(py::make_tuple(t.afferent, t.channel, py::array_t<double>(static_cast<py::ssize_t>(t.times.size()), t.times.data())));
        return out;
    });
}

}  // namespace corpuscle::python
