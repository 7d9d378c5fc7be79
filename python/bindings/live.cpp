#include "bindings/bindings.hpp"

namespace corpuscle::python {

void bind_live(py::module_& m) {
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

}  // namespace corpuscle::python
