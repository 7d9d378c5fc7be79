#pragma once
// Text for other simulators: equations in another language, numbers, and templates.

#include "model/equations/afferent_equations.hpp"
#include "run/export/targets.hpp"

namespace corpuscle {

/// The differences between a language and the expressions of model/equations.
struct EquationDialect {
    /// A function of the expressions and its text; $1 and $2 are the arguments: {"max", "clip($1, $2, inf)"}.
    struct Function {
        std::string_view name, text;
    };
    std::vector<Function> functions;
    /// A name that has another meaning in the language, and the name that replaces it.
    struct Name {
        std::string_view name, text;
    };
    std::vector<Name> names;

    std::string name(std::string_view) const;
    std::string expression(std::string_view) const;
};

/// A number that reads back as the same double: "5e-07", "1.0".
std::string number_text(double);

/// The template with each @NAME@ replaced by the text of this name. `values` must have all names of the template.
struct TemplateValue {
    std::string_view name;
    std::string text;
};
std::string fill_template(std::string_view text, const std::vector<TemplateValue>& values);

/// The name of an afferent as a name of programming languages: "sa1_nerve". Begins with a letter.
std::string identifier_of(std::string_view name);

/// An afferent to be exported.
struct ExportedAfferent {
    AfferentPlan plan;
    AfferentEquations equations;

    /// The value at the start of a state of the neuron, as an expression.
    std::string initial(const StateEquation&) const;
    /// "corpuscle export sa1 --for brian2 --set sa1.f_B=25Hz"
    std::string command;
    /// Lines for the head of a file, without comment signs.
    std::vector<std::string> heading;
};

/// The afferent of a request, for this target. Netlists and afferents without equations are errors.
Result<ExportedAfferent> exported_afferent(const ExportRequest&, const ExportTarget&);

/// Lines that begin with `prefix`.
std::string prefixed_lines(const std::vector<std::string>& lines, std::string_view prefix);

/// The Python function that both scripts read forces with.
extern const std::string_view python_force_reader;

/// The words with which every exported file names its origin.
inline constexpr std::string_view export_mark = "Written by 'corpuscle export ";
/// True for the beginning of a file with this mark.
bool has_export_mark(std::string_view beginning);

}  // namespace corpuscle
