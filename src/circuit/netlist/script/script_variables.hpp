#pragma once
// The variables of a script of ngspice. Used inside circuit/netlist only.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace corpuscle::circuit {

/// A variable in the text of a set command.
struct ScriptVariable {
    std::string name;
    std::optional<std::string> value;  ///< none for a flag, and for a list in parentheses
};
/// The variables of "NAME=VALUE NAME = VALUE NAME".
std::vector<ScriptVariable> read_variables(std::string_view text);

/// The variables that have a value.
class ScriptVariables {
    std::map<std::string, std::string, std::less<>> values_;

public:
    void set(const ScriptVariable& variable) {
        variable.value ? void(values_.insert_or_assign(variable.name, *variable.value)) : remove(variable.name);
    }
    void remove(std::string_view name) {
        if (const auto at = values_.find(name); at != values_.end()) values_.erase(at);
    }
    /// The text with $name replaced by its value, and $&name by number_of(name). A name without a value stays. Longer texts than the limit
    /// are not completed.
    std::string replace(std::string_view text, const std::function<std::optional<std::string>(std::string_view)>& number_of,
                        std::size_t limit) const;
};

}  // namespace corpuscle::circuit
