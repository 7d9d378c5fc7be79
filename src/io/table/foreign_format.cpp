#include "io/table/foreign_format.hpp"

#include <fmt/format.h>
#include <cstring>
#include <filesystem>

#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

/// An unsupported format of other programs, with a command that converts it.
struct ForeignFormat {
    std::string_view first;  ///< the bytes with which the file begins
    /// For formats that are zip archives: a text that must also occur in the first 512 bytes, unless the file has the extension of the
    /// format.
    /// "": "[Content_Types]", which occurs in files of Microsoft Office.
    std::string_view within;
    std::string_view extension;  ///< the usual file extension
    std::string_view description;
    std::string_view needs;  ///< Python packages or programs that the command requires
    /// {0} is the file as a Python string. {1} is the new name without extension, as the beginning of a Python string: the command adds the
    /// extension and the closing quote. {2} and {3} are the same names for a shell.
    std::string_view command;
};

// Commands; see ForeignFormat::command for their arguments. The index of a pandas table is written as a column if the format can have one,
// because it may be the time.
constexpr std::string_view workbook = R"py(python3 -c "import pandas; pandas.read_excel({0}).to_csv({1}.csv', index=False)")py";
constexpr std::string_view feather = R"py(python3 -c "import pandas; pandas.read_feather({0}).to_csv({1}.csv', index=False)")py";
constexpr std::string_view pickle = R"py(python3 -c "import pandas; pandas.read_pickle({0}).to_csv({1}.csv')")py";
constexpr std::string_view tdms =
    R"py(python3 -c "import nptdms; f = nptdms.TdmsFile.read({0}); c = [c for g in f.groups() for c in g.channels()]; )py"
    R"py(t = all('wf_increment' in k.properties for k in c); d = f.as_dataframe(time_index=t); d.columns = [k.name for k in c]; )py"
    R"py(d.to_csv({1}.csv', index_label=['index', 'time_s'][t])")py";
constexpr std::string_view matlab =
    R"py(python3 -c "import numpy, scipy.io; )py"
    R"py(numpy.savez({1}.npz', **{{k: v for k, v in scipy.io.loadmat({0}, squeeze_me=True).items() if k[0] != '_'}})")py";
constexpr std::string_view a_pickle = "a Python pickle (loading a pickle can run any code: only load files that you trust)";

constexpr ForeignFormat foreign_formats[] = {
    {"PK\x03\x04", "opendocument", ".ods", "an OpenDocument spreadsheet", "pandas and odfpy", workbook},
    {"PK\x03\x04", "", ".xlsx", "an Excel workbook", "pandas and openpyxl", workbook},
    {"\xd0\xcf\x11\xe0", "", ".xls", "an Excel workbook", "pandas and xlrd (2.0.1 or later)", workbook},
    {"PAR1", "", ".parquet", "a Parquet file", "pandas and pyarrow",
     R"py(python3 -c "import pandas; pandas.read_parquet({0}).to_csv({1}.csv')")py"},
    {"ARROW1", "", ".feather", "a Feather (Arrow) file", "pandas and pyarrow", feather},
    {"FEA1", "", ".feather", "a Feather file", "pandas and pyarrow", feather},
    {"TDSm", "", ".tdms", "a LabVIEW TDMS file", "nptdms and pandas", tdms},
    {"MATLAB 5.0 MAT-file", "", "", "a MATLAB file of version 5 to 7 (files of save -v7.3 can be read)", "scipy", matlab},
    {"\x80\x02", "", ".pkl", a_pickle, "pandas", pickle},
    {"\x80\x03", "", ".pickle", a_pickle, "pandas", pickle},
    {"\x80\x04", "", ".pkl", a_pickle, "pandas", pickle},
    {"\x80\x05", "", ".pkl", a_pickle, "pandas", pickle},
    {"#ROSBAG V", "", ".bag", "a ROS bag", "rostopic of ROS 1, and a topic from 'rosbag info' instead of /TOPIC",
     "rostopic echo -p -b {2} /TOPIC > {3}.csv"},
};

/// A compressed format: the bytes with which its files begin, the program that decompresses it, and the extension that this program
/// expects.
struct PackedFormat {
    std::string_view first, program, extension;
};
constexpr PackedFormat packed_formats[] = {
    {"BZh", "bzip2", ".bz2"},
    {"\xfd\x37zXZ", "xz", ".xz"},
    {"\x28\xb5\x2f\xfd", "zstd", ".zst"},
};

/// A supported binary format: the bytes with which its files begin, and the file extension that is required.
struct BinaryFormat {
    std::string_view first, description, extension;
};
constexpr BinaryFormat binary_formats[] = {
    {"\x89HDF", "an HDF5 file", ".h5"}, {"\x93NUMPY", "a NumPy array", ".npy"}, {"PK\x03\x04", "a NumPy archive", ".npz"},
    {"RIFF", "a WAV file", ".wav"},     {"fLaC", "a FLAC file", ".flac"},
};

/// True if the path needs no quotes in a shell and does not begin like an option.
bool is_safe_in_shell(const std::string& path) {
    return !path.empty() && path.front() != '-' && std::all_of(path.begin(), path.end(), [](unsigned char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' || c == '_' || c == '/' || c == '-' ||
               c == '+';
    });
}

/// The file name without its extension.
std::string stem_of(const std::string& path) { return std::filesystem::path(path).stem().string(); }

/// The file name for a command. Standard input ("-") is called FILE: the user must save it to a file first.
std::string named_file(const std::string& path) { return path == "-" ? "FILE" : path; }

/// The message for a file in a foreign format.
std::string message_for(const ForeignFormat& f, const std::string& path) {
    const auto name = named_file(path);
    // The command has Python code in double quotes, and in it the name in single quotes. A name that would break this is replaced
    // by FILE.
    const bool simple = std::all_of(name.begin(), name.end(), [](unsigned char c) { return c >= ' ' && !std::strchr("'\"\\$`!", c); });
    const std::string file = simple ? name : "FILE", stem = simple ? stem_of(name) : "FILE";
    return fmt::format("this is {}, which is not supported; with {}, convert it like this: {}", f.description, f.needs,
                       fmt::format(fmt::runtime(f.command), "'" + file + "'", "'" + stem, quote_shell_word(file), quote_shell_word(stem)));
}

}  // namespace

std::string quote_shell_word(const std::string& path) {
    if (is_safe_in_shell(path)) return path;
    std::string out = "'";
    for (const char c : path) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

std::string unpack_command(const std::string& program, std::string_view extension, const std::string& path) {
    const auto file = named_file(path);
    if (file.size() > extension.size() && file.ends_with(extension)) return fmt::format("{} -dk {}", program, quote_shell_word(file));
    return fmt::format("{} -dc < {} > {}", program, quote_shell_word(file), quote_shell_word(stem_of(file) + "-unpacked"));
}

std::string describe_foreign_format(std::string_view first, const std::string& path) {
    const auto extension = lower(std::filesystem::path(path).extension().string());
    for (const auto& p : packed_formats)
        if (first.starts_with(p.first))
            return fmt::format("this file is compressed with {}, which is not supported; convert it like this: {}", p.program,
                               unpack_command(std::string(p.program), p.extension, path));
    for (const auto& f : foreign_formats) {
        const bool zip = f.first == "PK\x03\x04";
        if (!first.starts_with(f.first)) continue;
        if (zip && extension != f.extension &&
            !(f.within.empty() ? first.find("[Content_Types]") != first.npos : first.find(f.within) != first.npos))
            continue;
        return message_for(f, path);
    }
    return "";
}

std::string describe_misnamed_format(std::string_view first, const std::string& path) {
    if (first.starts_with("PK\x03\x04") && first.find(".npy") == first.npos)
        return fmt::format("this is a ZIP archive; extract its files: unzip {}", quote_shell_word(path));
    for (const auto& m : binary_formats)
        if (first.starts_with(m.first)) {
            const auto stem = stem_of(path).empty() ? "FILE" : stem_of(path);
            return fmt::format("this is {}, but its file extension is wrong; give it the right name: ln -s {} {}", m.description,
                               quote_shell_word(path), quote_shell_word(stem + std::string(m.extension)));
        }
    return "";
}

}  // namespace corpuscle
