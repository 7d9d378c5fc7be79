#pragma once
// The datasets of NIR files, for tests.

#include "core/error.hpp"
#include "io/hdf5/hdf5_tree.hpp"
#include "nir/network.hpp"

namespace corpuscle::test {

/// The datasets of a file, which a test completes.
class NirFile {
    std::vector<Hdf5Array> arrays_;
    std::vector<std::string> edges_;
    std::string group_ = "/node";

public:
    NirFile() { text("/version", "1.0"), text("/node/type", "NIRGraph"); }

    void text(const std::string& path, const std::string& value) { arrays_.push_back({path, {}, true, false, {}, {value}}); }
    void numbers(const std::string& path, std::vector<std::uint64_t> shape, std::vector<double> values) {
        arrays_.push_back({path, std::move(shape), false, false, std::move(values), {}});
    }
    void node(const std::string& name, const std::string& type) { text("/node/nodes/" + name + "/type", type); }
    /// A parameter of one dimension.
    void set(const std::string& name, const std::string& parameter, std::vector<double> values) {
        const std::uint64_t size = values.size();
        numbers("/node/nodes/" + name + "/" + parameter, {size}, std::move(values));
    }
    void port(const std::string& name, const std::string& type, double width) { node(name, type), set(name, "shape", {width}); }
    void matrix(const std::string& name, std::uint64_t rows, std::vector<double> weight) {
        node(name, "Linear");
        const std::uint64_t columns = weight.size() / rows;
        numbers("/node/nodes/" + name + "/weight", {rows, columns}, std::move(weight));
    }
    void edge(const std::string& from, const std::string& to) { edges_.push_back(from), edges_.push_back(to); }
    void chain(std::initializer_list<const char*> names) {
        for (auto at = names.begin(); at + 1 != names.end(); ++at) edge(at[0], at[1]);
    }

    std::vector<Hdf5Array> arrays() const {
        auto all = arrays_;
        all.push_back({"/node/edges", {edges_.size() / 2, 2}, true, false, {}, edges_});
        return all;
    }
    /// The datasets without the one at this path.
    std::vector<Hdf5Array> without(const std::string& path) const {
        auto all = arrays();
        std::erase_if(all, [&](const auto& a) { return a.path == path; });
        return all;
    }
};

}  // namespace corpuscle::test
