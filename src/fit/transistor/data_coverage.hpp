#pragma once
// The range of voltages, temperatures and inversion levels that the points cover, and so which parameters they determine.

#include "fit/transistor/curve_residuals.hpp"

namespace corpuscle {

struct DataCoverage {
    double gate_range = 0, bulk_range = 0;                  ///< V: range of V_GB and of V_SB
    double least_inversion = 1e300, largest_inversion = 0;  ///< of the inversion coefficient, over conducting points
    std::size_t weak_points = 0;                            ///< points in weak inversion
    double saturated_range = 0;                             ///< V: range of V_DS in saturation
    double least_temperature = 1e300, highest_temperature = -1e300;
    double least_width = 1e300, largest_width = 0, least_length = 1e300;
    std::size_t junction_points = 0;  ///< points that tell a junction's current
    std::size_t devices = 0;
    bool is_geometry_known = true;
};

/// With the inversion levels of this card.
DataCoverage coverage_of(const IvData&, const CurveResiduals&, const circuit::UicmCard&);

/// Why the data cannot tell this parameter, and which data would: "all points ...; measure ...". "": they may.
std::string missing_data(const DataCoverage&, std::string_view card_name);
/// Which data would tell a parameter whose interval is too wide.
std::string better_data(std::string_view card_name);

/// The number of devices from which a standard deviation between them is computed.
inline constexpr std::size_t min_devices = 10;

}  // namespace corpuscle
