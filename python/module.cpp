// The extension module: the public interface with numpy arrays. Arrays go in and out without a copy. The package in corpuscle/ adds what
// is easier to say in Python.

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <chrono>
#include <memory>

#include "corpuscle.hpp"

namespace py = pybind11;
using namespace corpuscle;

namespace {

/// An array that shows memory of `owner`, and keeps it alive.
template <class T>
py::array view_of(const std::vector<T>& values, py::handle owner) {
    py::array_t<T> out(static_cast<py::ssize_t>(values.size()), values.data(), owner);
    py::detail::array_proxy(out.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return std::move(out);
}

/// The force of an array with a row for each sample and a column for each channel, or with one channel. It must be of aligned doubles.
ForceView view_of_array(const py::array_t<double>& array, double rate, double start, std::vector<std::string> channels, std::string name) {
    if (array.ndim() != 1 && array.ndim() != 2)
        throw InputError("force: the array has " + std::to_string(array.ndim()) +
                         " dimensions; it must have one, or two: [sample, channel]");
    constexpr auto size = static_cast<py::ssize_t>(sizeof(double));
    if (array.strides(0) % size != 0) throw InputError("force: the array is not aligned");
    ForceView out;
    out.name = std::move(name), out.rate = rate, out.start = start, out.channels = std::move(channels);
    out.count = static_cast<std::size_t>(array.shape(0));
    out.stride = array.strides(0) / size;
    if (out.count == 0) return out;  // refused by respond(); data() would be outside the array
    const auto columns = array.ndim() == 2 ? array.shape(1) : 1;
    for (py::ssize_t c = 0; c < columns; ++c) out.samples.push_back(array.ndim() == 2 ? array.data(0, c) : array.data());
    return out;
}

/// The progress function of Python, called at most 20 times a second, and Ctrl-C. The run copies it without Python's lock, so it holds the
/// function by a pointer whose count needs no lock.
std::function<bool(double)> progress_of(const py::object& function) {
    const std::shared_ptr<py::object> shared(new py::object(function), [](py::object* f) {
        py::gil_scoped_acquire lock;
        delete f;
    });
    return [shared, last = std::chrono::steady_clock::now()](double fraction) mutable {
        const auto now = std::chrono::steady_clock::now();
        if (now - last < std::chrono::milliseconds(50) && fraction < 1) return true;
        last = now;
        py::gil_scoped_acquire lock;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (shared->is_none()) return true;
        const py::object go_on = (*shared)(fraction);
        if (go_on.is_none()) return true;
        const int truth = PyObject_IsTrue(go_on.ptr());
        if (truth < 0) throw py::error_already_set();
        return truth == 1;
    };
}

py::list samples_of(const Force& force, py::handle owner) {
    py::list out;
    for (const auto& channel : force.samples) out.append(view_of(channel, owner));
    return out;
}

std::vector<std::string> column(const Response& response, std::string RespondingAfferent::* member) {
    std::vector<std::string> out;
    for (const auto& a : response.afferents) out.push_back(a.*member);
    return out;
}

}  // namespace

PYBIND11_MODULE(_corpuscle, m) {
    m.doc() = "The compiled part of corpuscle.";
    static py::exception<InputError> input_error(m, "InputError", PyExc_ValueError);
    static py::exception<NotConvergedError> not_converged(m, "NotConvergedError", input_error.ptr());
    py::register_exception_translator([](std::exception_ptr p) {
        try {
            std::rethrow_exception(p);
        } catch (const NotConvergedError& e) {
            not_converged(e.what());
        } catch (const InputError& e) {
            input_error(e.what());
        } catch (const InterruptedError& e) {
            PyErr_SetString(PyExc_KeyboardInterrupt, e.what());
        }
    });

    py::class_<Force>(m, "Force")
        .def_readonly("name", &Force::name)
        .def_readonly("rate", &Force::rate)
        .def_readonly("start", &Force::start)
        .def_readonly("channels", &Force::channels)
        .def_readonly("notes", &Force::notes)
        .def_readonly("warnings", &Force::warnings)
        .def_property_readonly("samples", [](py::object self) { return samples_of(self.cast<const Force&>(), self); });
    m.def("stimulus", &stimulus, py::arg("name"), py::arg("settings"), py::arg("rate"), py::arg("seed"));
    m.def("read_recording", &read_recording, py::arg("path"), py::arg("options"), py::call_guard<py::gil_scoped_release>());

    py::class_<Simulation>(m, "Simulation")
        .def(py::init<>())
        .def_readwrite("afferents", &Simulation::afferents)
        .def_readwrite("population", &Simulation::population)
        .def_readwrite("contact", &Simulation::contact)
        .def_readwrite("taxels", &Simulation::taxels)
        .def_readwrite("settings", &Simulation::settings)
        .def_readwrite("copies", &Simulation::copies)
        .def_readwrite("spreads", &Simulation::spreads)
        .def_readwrite("seed", &Simulation::seed)
        .def_readwrite("noise", &Simulation::noise)
        .def_readwrite("backward_euler", &Simulation::backward_euler)
        .def_readwrite("sampled", &Simulation::sampled)
        .def_readwrite("single_precision", &Simulation::single_precision)
        .def_readwrite("threads", &Simulation::threads);

    py::class_<Response>(m, "Response")
        .def_property_readonly("times", [](py::object self) { return view_of(self.cast<const Response&>().times, self); })
        .def_property_readonly("indices", [](py::object self) { return view_of(self.cast<const Response&>().indices, self); })
        .def_property_readonly("names", [](const Response& r) { return column(r, &RespondingAfferent::name); })
        .def_property_readonly("types", [](const Response& r) { return column(r, &RespondingAfferent::type); })
        .def_property_readonly("channels", [](const Response& r) { return column(r, &RespondingAfferent::channel); })
        .def_property_readonly("positions",
                               [](const Response& r) {
                                   py::array_t<double> out({static_cast<py::ssize_t>(r.afferents.size()), py::ssize_t{2}});
                                   for (std::size_t k = 0; k < r.afferents.size(); ++k)
                                       out.mutable_at(k, 0) = r.afferents[k].x, out.mutable_at(k, 1) = r.afferents[k].y;
                                   return out;
                               })
        .def_readonly("start", &Response::start)
        .def_readonly("duration", &Response::duration)
        .def_readonly("notes", &Response::notes)
        .def_readonly("warnings", &Response::warnings)
        .def("summary", [](const Response& r) { return r.summary(); });

    m.def(
        "respond",
        [](const py::array_t<double>& force, double rate, double start, std::vector<std::string> channels, std::string name,
           Simulation simulation, const py::object& progress) {
            const auto view = view_of_array(force, rate, start, std::move(channels), std::move(name));
            simulation.progress = progress_of(progress);
            py::gil_scoped_release released;
            return respond(view, simulation);
        },
        py::arg("force").noconvert(), py::arg("rate"), py::arg("start"), py::arg("channels"), py::arg("name"), py::arg("simulation"),
        py::arg("progress"));
    m.def(
        "respond_to",
        [](const std::string& name, Simulation simulation, double rate, const py::object& progress) {
            simulation.progress = progress_of(progress);
            py::gil_scoped_release released;
            return respond_to(name, simulation, rate);
        },
        py::arg("name"), py::arg("simulation"), py::arg("rate"), py::arg("progress"));

    m.def("instantaneous_rates", [](const py::array_t<double, py::array::c_style | py::array::forcecast>& train) {
        return instantaneous_rates({train.data(), static_cast<std::size_t>(train.size())});
    });
    m.def("measure_catalogue", [] {
        py::list out;
        for (const auto& d : measure_catalogue()) out.append(py::make_tuple(d.name, d.unit, d.description));
        return out;
    });
    m.def("catalogues", &catalogues);
    m.def("catalogue", [](const std::string& name) {
        py::list out;
        for (const auto& e : catalogue(name)) {
            py::list parameters;
            for (const auto& p : e.parameters)
                parameters.append(py::make_tuple(p.name, p.unit, p.default_value, p.low, p.high, p.description, p.source));
            out.append(py::make_tuple(e.name, e.detail, e.description, e.source, parameters));
        }
        return out;
    });
    m.def("measure_train", [](const py::array_t<double, py::array::c_style | py::array::forcecast>& train, double from, double to) {
        return measure_train({train.data(), static_cast<std::size_t>(train.size())}, from, to);
    });

    py::class_<LiveSkin>(m, "LiveSkin")
        .def(py::init<const std::string&, double, std::size_t, const std::vector<std::string>&>(), py::arg("population"), py::arg("rate"),
             py::arg("channels"), py::arg("settings"))
        .def_static("with_taxels", &LiveSkin::with_taxels)
        .def_property_readonly("frame_size", &LiveSkin::frame_size)
        .def_property_readonly("sites", &LiveSkin::sites)
        .def_property_readonly("afferents", &LiveSkin::afferents)
        .def_property_readonly("frames", &LiveSkin::frames)
        .def("afferent_name", &LiveSkin::afferent_name)
        .def("site",
             [](const LiveSkin& s, std::size_t number) {
                 const auto site = s.site(number);
                 return py::make_tuple(site.name, site.x, site.y);
             })
        .def("push",
             [](LiveSkin& s, const py::array_t<double, py::array::c_style | py::array::forcecast>& frame) {
                 py::list out;
                 for (const auto& e : s.respond({frame.data(), static_cast<std::size_t>(frame.size())}))
                     out.append(py::make_tuple(e.time, e.afferent_index));
                 return out;
             })
        .def("finish",
             [](LiveSkin& s) {
                 py::list out;
                 for (const auto& e : s.finish()) out.append(py::make_tuple(e.time, e.afferent_index));
                 return out;
             })
        .def("save",
             [](const LiveSkin& s) {
                 const auto bytes = s.save();
                 return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
             })
        .def("resume",
             [](LiveSkin& s, const std::string& bytes) { s.resume({reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()}); });
}
