#pragma once
// Reads the .raw files of SPICE simulators (binary or ASCII), so that tests can compare Corpuscle's curves with another simulator's.

#include <charconv>
#include <complex>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "circuit/output/point_sink.hpp"

namespace corpuscle::circuit {

/// All plots in the contents of a .raw file.
inline std::vector<Plot> read_raw(const std::string& text) {
    std::vector<Plot> plots;
    std::size_t at = 0, variables = 0, points = 0;
    Plot plot;
    const auto line = [&] {
        const auto end = text.find('\n', at);
        auto out = text.substr(at, end - at);
        at = end == std::string::npos ? text.size() : end + 1;
        return out;
    };
    const auto number = [&]() {
        double x = 0;
        std::memcpy(&x, text.data() + at, sizeof x);
        at += sizeof x;
        return x;
    };
    while (at < text.size()) {
        const auto head = line();
        if (head.starts_with("Title:")) plot = {};
        if (head.starts_with("Plotname: ")) plot.name = head.substr(10);
        if (head.starts_with("Flags: ")) plot.is_complex = head.find("complex") != std::string::npos;
        if (head.starts_with("No. Variables: ")) variables = std::stoul(head.substr(15));
        if (head.starts_with("No. Points: ")) points = std::stoul(head.substr(12));
        if (head.starts_with("Variables:"))
            for (std::size_t k = 0; k < variables; ++k) {
                std::istringstream words(line());
                std::string index, name, type;
                words >> index >> name >> type;
                plot.curves.push_back({name, type, {}});
            }
        const bool binary = head.starts_with("Binary:");
        if (!binary && !head.starts_with("Values:")) continue;
        for (std::size_t p = 0; p < points; ++p)
            for (std::size_t k = 0; k < variables; ++k) {
                double re = 0, im = 0;
                if (binary) {
                    if (at + (plot.is_complex ? 16 : 8) > text.size()) throw std::runtime_error("truncated .raw file");
                    re = number();
                    if (plot.is_complex) im = number();
                } else {
                    std::istringstream words(line());
                    std::string word;  // the last word of the line is the value; the first line of a point begins with its index
                    while (words >> word) {
                    }
                    const auto comma = word.find(',');
                    re = std::stod(word), im = comma == std::string::npos ? 0 : std::stod(word.substr(comma + 1));
                }
                plot.curves[k].values.emplace_back(re, im);
            }
        plots.push_back(plot);
    }
    return plots;
}

inline std::vector<Plot> read_raw_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return read_raw(text.str());
}

}  // namespace corpuscle::circuit
