#pragma once
// The transistor arrays of the thesis's appendix B: the published tables, and our simulation at the same bias of 0.5 V.

#include <span>
#include <string>
#include <vector>

#include "reproduction/claims/study.hpp"

namespace corpuscle {

/// An array's row of tables 10 to 12 or 13 to 15 exactly as printed, misprints included; areas in um^2, the rest in the units of the
/// table's head.
struct PublishedArray {
    const char *name, *subcircuit;                        ///< subcircuit: its name in the netlist
    double rows, columns;                                 ///< unit transistors along W and along L as drawn; inferred from A_T
    double S, A, A_T, area_ratio;                         ///< S_eq; channel area, total area, A/A_T
    double g_md, g_mg, g_ms, g_mb, I_D, V_T;              ///< transconductances of drain, gate, source and bulk; drain current; threshold
    double g_by_I, V_A, gain, bulk_ratio, g_by_A, sigma;  ///< g_mg/I_D, I_D/g_md, g_mg/g_md, g_mb/g_mg, g_mg/A, spread of I_D
};

/// The tables of one kind of array, rectangular or trapezoidal. g_md_unit and g_by_A_unit are the correct units of the columns g_md and
/// g_mg/A, in S and S/um^2; they differ from the printed ones.
struct PublishedArrays {
    const char* circuit;  ///< netlist with all these arrays
    std::span<const PublishedArray> arrays;
    const char *sizes_table, *small_signal_table, *ratios_table;  ///< "table 10"
    double g_md_unit, g_by_A_unit;
    const char *g_md_note, *g_by_A_note;  ///< remark if the correct unit differs from the printed one; else ""
};

inline constexpr PublishedArray published_rectangles[] = {
    // clang-format off
    {"A", "xa", 1, 1, 2.3333, 0.0756, 1.0120, 0.075, 1.021, 31.83, 41.28, 8.430, 2.141, 531.7, 14.87, 2.10, 29.9, 0.265, 421.0, 15.6},
    {"B1", "xb1", 2, 1, 0.2333, 0.7560, 3.0132, 0.251, 0.013, 3.272, 4.154, 0.869, 0.240, 479.6, 13.63, 18.4, 48.0, 0.265, 4.328, 4.41},
    {"B2", "xb2", 2, 2, 0.5833, 0.3024, 3.0132, 0.100, 0.067, 7.691, 9.809, 2.051, 0.510, 531.7, 15.07, 7.65, 41.2, 0.266, 25.43, 8.00},
    {"C1", "xc1", 1, 1, 1.2444, 1.0800, 3.0132, 0.335, 0.079, 13.97, 17.91, 3.857, 0.853, 501.4, 16.38, 10.8, 45.0, 0.276, 13.86, 4.39},
    {"C2", "xc2", 2, 2, 2.3333, 0.3024, 3.0132, 0.100, 0.498, 30.67, 39.34, 8.165, 2.048, 531.7, 14.98, 4.11, 35.8, 0.266, 101.4, 7.73},
    {"D1", "xd1", 1, 2, 12.444, 0.4032, 3.0132, 0.134, 3.808, 125.2, 163.3, 34.31, 6.928, 553.7, 18.02, 1.82, 30.3, 0.274, 310.5, 7.97},
    {"D2", "xd2", 2, 2, 9.3333, 0.3024, 3.0132, 0.100, 4.085, 127.3, 165.5, 33.72, 8.565, 531.7, 14.86, 2.10, 29.9, 0.265, 421.0, 7.41},
    // clang-format on
};

/// F has its short transistor at the drain, as in the thesis's text.
inline constexpr PublishedArray published_trapezoids[] = {
    // clang-format off
    {"E", "xe", 1, 1, 0.0805, 2.1924, 5.6856, 0.386, 31.73, 1.550, 1.963, 0.410, 0.120, 441.4, 12.96, 37.82, 53.8, 0.264, 0.709, 2.36},
    {"F", "xf", 1, 2, 0.0845, 2.0874, 5.6856, 0.367, 36.85, 1.587, 2.010, 0.419, 0.123, 442.6, 12.90, 33.38, 52.7, 0.264, 0.760, 2.51},
    {"G1", "xg1", 1, 8, 0.2917, 0.6048, 5.6856, 0.106, 180.7, 3.886, 4.941, 1.038, 0.256, 531.7, 15.18, 14.17, 46.7, 0.267, 6.425, 5.77},
    {"G2", "xg2", 1, 8, 0.5490, 0.6048, 5.6856, 0.106, 103.5, 6.988, 8.869, 1.870, 0.461, 531.7, 15.17, 44.54, 56.6, 0.268, 11.55, 7.46},
    {"G3", "xg3", 1, 8, 2.0416, 0.6048, 5.6856, 0.106, 691.1, 23.52, 29.91, 6.316, 1.531, 531.7, 15.36, 22.15, 50.6, 0.269, 38.89, 14.9},
    // clang-format on
};

inline constexpr PublishedArrays rectangles = {
    "rectangular_arrays", published_rectangles, "table 10", "table 11", "table 12", 1e-6, 1e-6, "nS corrected to uS: errata U7", ""};
inline constexpr PublishedArrays trapezoids = {
    "trapezoidal_arrays",        published_trapezoids,           "table 13", "table 14", "table 15", 1e-10, 1e-6,
    "divided by ten: errata U8", "nS corrected to uS: errata U9"};

/// The array of this name, which must exist.
const PublishedArray& find_published(const PublishedArrays&, std::string_view name);

/// Our simulation of an array; SI units.
struct SimulatedArray {
    const PublishedArray* published = nullptr;
    double W = 0;                                      ///< channel width of a unit transistor
    std::vector<double> lengths{};                     ///< channel length of each unit transistor, beginning at the drain
    double S = 0, A = 0, A_T = 0, A_VT = 0, A_IS = 0;  ///< S_eq; channel and total area; mismatch, from the card
    double g_md = 0, g_mg = 0, g_ms = 0, g_mb = 0, I_D = 0, V_T = 0;
    double g_by_I() const { return g_mg / I_D; }
    double V_A() const { return I_D / g_md; }
    double gain() const;  ///< dB
    double bulk_ratio() const { return g_mb / g_mg; }
    double g_by_A() const { return 1e-12 * g_mg / A; }  ///< S/um^2
    /// Standard deviation of I_D (% of I_D) of one transistor of the same area, by A_VT and A_IS, with this g_mg/I_D (1/V).
    double predicted_mismatch(double with_g_by_I) const;
};
struct SimulatedArrays : std::vector<SimulatedArray> {
    const SimulatedArray& operator()(std::string_view name) const;  ///< the array of this name, which must exist
};

/// Simulates the arrays at V_G = V_D = 0.5 V; every unit transistor is solved.
Result<SimulatedArrays> simulate_arrays(const PublishedArrays&);
/// A subcircuit of a netlist, and the table row that it is compared with.
struct ArrayMatch {
    const PublishedArray* published;
    std::string subcircuit;
};
/// All arrays of the tables, each matched with its own subcircuit.
std::vector<ArrayMatch> all_matches(const PublishedArrays&);
Result<SimulatedArrays> simulate_arrays(const char* circuit, std::span<const ArrayMatch>);
/// Standard deviation over mean (%) of each array's drain current over simulated chips, in the order of the matches.
Result<std::vector<double>> simulate_mismatch(const char* circuit, std::span<const ArrayMatch>);
Result<std::vector<double>> simulate_mismatch(const PublishedArrays&);
/// Relative statistical uncertainty (%) of a standard deviation from simulate_mismatch.
double mismatch_uncertainty();

/// A column of a table: the published number, and the function that computes the same quantity in `unit`.
struct TableColumn {
    const char *quantity, *unit;
    double (*computed)(const SimulatedArray&);
    double PublishedArray::* published;
    double factor = 1;                                  ///< published number times factor is in `unit`
    std::string (*reason)(const SimulatedArray&) = {};  ///< reason for a deviation; null: none
    const char* source_note = "";                       ///< remark on the unit if the head of the table is wrong
};
/// Adds one claim for each array. `source` is the table.
void add_column(StudyResult&, const TableColumn&, const SimulatedArrays&, const std::string& source);

/// Add the columns of the three tables. `sigmas` is the result of simulate_mismatch for the same arrays.
void add_sizes(StudyResult&, const PublishedArrays&, const SimulatedArrays&);
void add_small_signals(StudyResult&, const PublishedArrays&, const SimulatedArrays&);
void add_ratios(StudyResult&, const PublishedArrays&, const SimulatedArrays&);
void add_mismatch(StudyResult&, const PublishedArrays&, const SimulatedArrays&, const std::vector<double>& sigmas);

/// The identity g_mg + g_md + g_mb = g_ms (eq. 27) gives the unit of the printed g_md. Adds a claim that the published sum
/// fits better with this unit than with `printed_unit` (S), the one in the table's head.
void add_sum_rule(StudyResult&, const PublishedArrays&, double printed_unit, const std::string& erratum);
/// The same check with the ratio I_D/g_md, which has a printed column of its own (V_A).
void add_ratio_rule(StudyResult&, const PublishedArrays&, double printed_unit, const std::string& erratum);

}  // namespace corpuscle
