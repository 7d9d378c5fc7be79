#pragma once
// I-V curves of transistors: the points of all files with their devices.

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// The quantities that a column or an option can give. v_gs, v_ds and v_bs are referred to the source, v_g to v_b to ground.
enum class IvQuantity : std::uint8_t { v_g, v_d, v_s, v_b, v_gs, v_ds, v_bs, i_d, i_b, temperature, width, length, device };
inline constexpr std::string_view iv_quantity_names[] = {"v_g", "v_d", "v_s",         "v_b",   "v_gs",   "v_ds",  "v_bs",
                                                         "i_d", "i_b", "temperature", "width", "length", "device"};
inline constexpr std::size_t iv_quantities = std::size(iv_quantity_names);

/// One point of a curve. Currents flow into the terminals, and have their real sign.
struct IvPoint {
    std::array<double, 4> v = {};                           ///< drain, gate, source, bulk, V
    double I_D = 0;                                         ///< A
    double I_B = std::numeric_limits<double>::quiet_NaN();  ///< A; NaN: not measured
    double temperature = 27;                                ///< C
    std::uint32_t device = 0, curve = 0, file = 0;          ///< indices
};

struct IvDevice {
    std::string name;
    double W = 1e-6, L = 1e-6;  ///< m
};

/// A run of points of one device at one temperature, along which the same terminals' voltages rise or fall.
struct IvCurve {
    std::size_t begin = 0, end = 0;  ///< points
    int swept = 0;                   ///< the terminals whose voltage varies: the sum of 1 << terminal
};

struct IvData {
    std::vector<IvPoint> points;
    std::vector<IvDevice> devices;
    std::vector<IvCurve> curves;
    bool is_pmos = false;
    bool is_geometry_known = true;   ///< false: W and L are 1 um for want of other values
    std::vector<std::string> notes;  ///< what was assumed
};

/// A column chosen by --column: the heading, and -1 if the opposite sign is meant.
struct IvColumnChoice {
    IvQuantity quantity;
    std::string heading;
    double sign = 1;
};
/// Reads "i_d=-i(vd)".
Result<IvColumnChoice> parse_column_choice(const std::string& text);

struct IvOptions {
    std::vector<IvColumnChoice> columns;
    std::optional<bool> is_pmos;  ///< nullopt: from the signs
    /// For files without such a column: one value for all files, or one for each. In SI and Celsius.
    std::vector<double> width, length, temperature, v_ds, v_bs;
};

/// Reads the files: .raw of SPICE, or tables of text. A point whose numbers are impossible is an error with its place.
Result<IvData> read_iv_files(const std::vector<std::string>& paths, const IvOptions&);

/// Decides between NMOS and PMOS, by the signs if `is_pmos` does not. A PMOS may be given by magnitudes; then all signs are inverted.
/// `path`: for messages.
Result<void> set_polarity(IvData&, std::optional<bool> is_pmos, const std::string& path);

/// Divides the points into curves.
void divide_into_curves(IvData&);

}  // namespace corpuscle
