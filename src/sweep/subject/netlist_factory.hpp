#pragma once
// Makes the netlists of a sweep's items from the fixed settings and the varied parameters. Each source file is read only once.

#include <map>
#include <memory>
#include <mutex>
#include <span>

#include "circuit/variant/netlist_overrides.hpp"
#include "sweep/spec/axis.hpp"

namespace corpuscle::sweeps {

class NetlistFactory {
    struct Files;             // the source files read so far
    std::string name_;        // of the subject, without an absolute path
    std::string folder_;      // of the files, unless they are embedded
    std::string file_;        // path of the netlist, relative to folder_, or among the embedded files
    std::string directives_;  // replace those of the netlist; empty: the netlist's own
    bool is_embedded_ = false;
    std::vector<ParameterOverride> overrides_;  // fixed settings
    struct VariedParameter {
        std::string name;
        std::size_t axis;                 // index in the plan
        std::vector<std::string> labels;  // of the axis; empty if its values are numbers
    };
    std::vector<VariedParameter> varied_;
    std::vector<std::string> saved_curves_;  // replace those of .save; empty: the netlist's own
    std::shared_ptr<Files> files_;

    /// The netlist with this corner of the process file; "": the corner that the netlist selects.
    Result<circuit::Netlist> open(const std::string& corner) const;
    /// The netlist with these overrides and the saved curves.
    Result<circuit::Netlist> with_overrides(std::span<const ParameterOverride>) const;
    /// An override of this netlist for a setting or a varied value of the sweep file.
    ParameterOverride override_of(const std::string& name, std::string value) const;

public:
    /// `name_or_path`: "sa1-circuit", a path relative to `folder`, or the path of an embedded netlist. `directives`: if not empty, they
    /// replace those of the netlist.
    static Result<NetlistFactory> of(const LocatedText& name_or_path, const std::string& folder, const std::string& directives = "");

    const std::string& name() const { return name_; }
    /// Adds a fixed setting.
    Result<void> set(const LocatedSetting&);
    Result<VariedQuantity> find_quantity(const LocatedText& quantity);
    bool varies() const { return !varied_.empty(); }
    /// Replaces the curves of all .save lines.
    void save(std::vector<std::string> curves) { saved_curves_ = std::move(curves); }

    /// The netlist with the fixed settings, but without varied values.
    Result<circuit::Netlist> nominal() const { return with_overrides(overrides_); }
    /// The netlist for an item's values on all axes. Thread-safe.
    Result<circuit::Netlist> at(std::span<const double> values) const;
    /// The part of an item's values on which its netlist depends.
    std::vector<double> netlist_values(std::span<const double> values) const;

    /// The path of the netlist's file, for text_of(), and the folder of the files; "" if they are embedded in the program.
    const std::string& file() const { return file_; }
    std::string folder() const { return is_embedded_ ? "" : folder_; }
    bool is_embedded() const { return is_embedded_; }
    /// The text of a source file; `path` is relative to the folder, or that of an embedded file.
    Result<std::string> text_of(const std::string& path) const;
    /// One entry for each file that was read, with its text.
    std::vector<MetadataText> metadata() const;
};

/// True if two circuits have the same devices at the same nodes and differ at most in numbers.
bool same_devices(const circuit::Circuit&, const circuit::Circuit&);

}  // namespace corpuscle::sweeps
