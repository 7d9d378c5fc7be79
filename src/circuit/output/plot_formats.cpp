#include "circuit/output/plot_formats.hpp"

#include <fmt/format.h>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <iterator>

#include "core/text/csv_field.hpp"

namespace corpuscle::circuit {
namespace {

void append_bytes(std::string& out, double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    for (int k = 0; k < 8; ++k) out += static_cast<char>(bits >> (8 * k));
}

bool has_two_columns(const Plot& plot, const Curve& c) { return plot.is_complex && c.type != "frequency"; }

/// The time in seconds since 1970 that the environment gives for files that must be the same in each run; 0 if it gives none.
std::time_t source_date() {
    constexpr std::time_t max = 253'402'300'799;  // the end of the year 9999
    const char* const text = std::getenv("SOURCE_DATE_EPOCH");
    std::time_t out = 0;
    if (text == nullptr) return 0;
    const std::string_view digits(text);
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), out);
    return read.ec == std::errc() && read.ptr == digits.data() + digits.size() && out >= 0 && out <= max ? out : 0;
}

/// The same bytes for the same input: never the present time.
std::string raw_date() {
    const std::time_t seconds = source_date();
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    constexpr std::string_view days[] = {"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
    constexpr std::string_view months[] = {"Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    return fmt::format("{} {} {:2} {:02}:{:02}:{:02} {}", days[utc.tm_wday], months[utc.tm_mon], utc.tm_mday, utc.tm_hour, utc.tm_min,
                       utc.tm_sec, utc.tm_year + 1900);
}

/// ngspice executes the line as a command when it loads the file; this one has no effect. Readers of several programs' files, such as
/// spicelib, look here for the name of the program whose format it is.
constexpr std::string_view raw_command = R"(set rawwriter="Corpuscle, format of ngspice")";

}  // namespace

std::string raw_count(std::size_t points) { return fmt::format("{:<20}", points); }

RawHeader raw_header(std::string_view title, const Plot& plot, bool binary) {
    RawHeader out;
    out.text = fmt::format("Title: {}\nDate: {}\nPlotname: {}\nFlags: {}\nNo. Variables: {}\nNo. Points: ", title, raw_date(), plot.name,
                           plot.is_complex ? "complex" : "real", plot.curves.size());
    out.count_offset = out.text.size();
    out.text += fmt::format("{}\nCommand: {}\nVariables:\n", raw_count(0), raw_command);
    for (std::size_t k = 0; k < plot.curves.size(); ++k)
        out.text += fmt::format("\t{}\t{}\t{}\n", k, plot.curves[k].name, plot.curves[k].type);
    out.text += binary ? "Binary:\n" : "Values:\n";
    return out;
}

void append_raw_point(std::string& out, std::size_t number, const PlotRow& row, bool binary) {
    const auto to = std::back_inserter(out);
    if (!binary) fmt::format_to(to, " {}", number);
    for (std::size_t k = 0; k < row.size(); ++k) {
        const auto x = row[k];
        if (binary) {
            append_bytes(out, x.real());
            if (row.is_complex()) append_bytes(out, x.imag());
        } else if (row.is_complex()) {
            fmt::format_to(to, "\t{:.15e},{:.15e}\n", x.real(), x.imag());
        } else {
            fmt::format_to(to, "\t{:.15e}\n", x.real());
        }
    }
}

std::string_view raw_footer(bool binary) { return binary ? "" : "\n"; }

std::string csv_header(const Plot& plot) {
    std::string out;
    for (const auto& c : plot.curves) {
        if (&c != &plot.curves[0]) out += ",";
        out += has_two_columns(plot, c) ? quote_csv_field(c.name + ".re") + "," + quote_csv_field(c.name + ".im") : quote_csv_field(c.name);
    }
    return out + '\n';
}

void append_csv_row(std::string& out, const Plot& head, const PlotRow& row) {
    const auto to = std::back_inserter(out);
    for (std::size_t k = 0; k < row.size(); ++k) {
        if (k > 0) out += ',';
        const auto x = row[k];
        has_two_columns(head, head.curves[k]) ? fmt::format_to(to, "{},{}", x.real(), x.imag()) : fmt::format_to(to, "{}", x.real());
    }
    out += '\n';
}

}  // namespace corpuscle::circuit
