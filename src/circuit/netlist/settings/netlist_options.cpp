#include <algorithm>
#include <limits>

#include "circuit/device/physical_constants.hpp"
#include "circuit/netlist/parsed_netlist.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

struct OptionRow {
    std::string_view name;
    bool takes_word;           // true: the value is a word; false: a number
    double min, max;           // allowed numbers
    std::string_view example;  // of a value, for messages
};
constexpr OptionRow option_rows[] = {
    {"reltol", false, 1e-15, 0.5, "1e-6"},
    {"vntol", false, 1e-300, 1, "1n"},
    {"abstol", false, 1e-300, 1, "1e-16"},
    {"gmin", false, 0, 1, "1e-15"},
    {"itl1", false, 1, 1e6, "500"},
    {"temp", false, -zero_celsius, max_celsius, "27"},
    {"tnom", false, -zero_celsius, max_celsius, "27"},
    {"scale", false, 1e-12, 1e12, "1e-6"},
    {"defl", false, 1e-9, 1e6, "1u"},
    {"defw", false, 1e-9, 1e6, "1u"},
    {"defad", false, 0, 1, "1p"},
    {"defas", false, 0, 1, "1p"},
    {"defnrd", false, 0, 1e6, "1"},
    {"defnrs", false, 0, 1e6, "1"},
    {"maxord", false, -no_limit, no_limit, "4"},
    {"spikecheck", false, 0, 1, "0"},
    {"noisefmax", false, 0, 1e15, "10k"},
    {"noisefmin", false, 1e-9, 1e15, "1"},
    {"noisescale", false, 0, 1e6, "1"},
    {"noiseseed", false, 0, 0x1p53, "7"},
    {"accuracy", true, 0, 0, "fine"},
    {"method", true, 0, 0, "gear"},
};

/// Options of other simulators that control iterations, memory or output. They are ignored, since they do not change the equations.
constexpr std::string_view without_effect[] = {
    "abstolpow",    "acct",     "autostop",   "bypass",        "chgtol",     "cptime",     "dvdt",        "gminsteps",  "gshuntsteps",
    "ingold",       "interp",   "itl2",       "itl3",          "itl4",       "itl5",       "itl6",        "keepopinfo", "klu",
    "limpts",       "limtim",   "linsolver",  "list",          "lvltim",     "measdgt",    "minbreak",    "noacct",     "noinit",
    "node",         "nomod",    "noopalter",  "noopiter",      "nopage",     "nutmeg",     "numdgt",      "numthreads", "num_threads",
    "opts",         "optran",   "oldlimit",   "output",        "pivrel",     "pivtol",     "plotwinsize", "post",       "probe",
    "relv",         "reli",     "runlvl",     "savecurrents",  "seed",       "sparse",     "srcsteps",    "threads",    "trtol",
    "trytocompact", "width",    "wnflag",     "xmu",           "numsteps",   "ngdebug",    "brief",       "scalestop",  "rawfmt",
    "autoconv",     "accurate", "fast",       "fastaccess",    "plotreltol", "plotabstol", "plotvntol",   "nomarch",    "topologycheck",
    "ngbehavior",   "maxstep",  "thev_induc", "dampinductors", "measout",    "ascii",      "psf",         "csdf",       "co",
    "lis_new",      "dcon",     "captab",     "unwrap",
};

/// Options that add elements too small to matter in most circuits. They are ignored with a warning.
constexpr std::string_view small_elements[] = {"rshunt", "gshunt", "cshunt", "cmin", "rseries", "minr", "resmin"};

/// Options that change the circuit itself. Ignoring them would simulate a different circuit, so they are errors.
constexpr std::string_view unsupported[] = {"scalm", "badmos3", "geoshrink", "parhier"};

template <class Names>
bool contains_name(const Names& names, std::string_view name) {
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

constexpr std::string_view xyce_packages[] = {
    "timeint",         "nonlin",           "nonlin-tran", "linsol",          "linsol-ac", "output", "measure", "diagnostic", "topology",
    "parser",          "sensitivity",      "restart",     "hbint",           "loca",      "fft",    "dist",    "nonlin-hb",  "linsol-hb",
    "nonlin-twolevel", "timeint-twolevel", "samples",     "embeddedsamples", "pces"};

/// Names to suggest for a typing error. def... are left out, because short options of other simulators resemble them.
auto option_names() {
    return option_rows | std::views::transform(&OptionRow::name) | std::views::filter([](auto name) { return !name.starts_with("def"); });
}

}  // namespace

bool is_option(std::string_view name) { return std::ranges::find(option_rows, name, &OptionRow::name) != std::end(option_rows); }

bool is_numeric_option(std::string_view name) {
    const auto* row = std::ranges::find(option_rows, name, &OptionRow::name);
    return row != std::end(option_rows) && !row->takes_word;
}

bool is_small_element_option(std::string_view name) { return contains_name(small_elements, name); }

bool is_foreign_option(std::string_view name) {
    return !is_option(name) && !contains_name(without_effect, name) && !contains_name(unsupported, name) &&
           !is_small_element_option(name) && did_you_mean(name, option_names()).empty();
}

XycePackage xyce_package(std::string_view word) {
    if (word == "device") return XycePackage::devices;
    return contains_name(xyce_packages, word) ? XycePackage::other : XycePackage::none;
}

Result<void> check_option(std::string_view name, std::optional<double> number, std::optional<std::string_view> word,
                          const SourceLocation& location) {
    const auto* row = std::find_if(std::begin(option_rows), std::end(option_rows), [&](const OptionRow& r) { return r.name == name; });
    if (row == std::end(option_rows)) {
        if (contains_name(without_effect, name) || is_small_element_option(name)) return {};
        if (contains_name(unsupported, name))
            return error_at(location, ".options {}: not supported, because it changes the circuit; set it at the elements instead", name);
        const auto hint = did_you_mean(name, option_names());
        return error_at(location, "unknown option '{}'{}", name, hint);
    }
    if (row->takes_word && word) return {};
    if (row->takes_word) return error_at(location, ".options {0}: expected a word, such as {0}={1}", name, row->example);
    if (!number) return error_at(location, ".options {0}: expected a number, such as {0}={1}", name, row->example);
    if (!(*number >= row->min && *number <= row->max))
        return error_at(location, ".options {}={:g} is outside [{:g}, {:g}]", name, *number, row->min, row->max);
    return {};
}

}  // namespace corpuscle::circuit
