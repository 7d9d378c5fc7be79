"""The additions that additions_work.py makes: for each, its kind in the table of HACKING.md, its new file, and its lines in the list."""

from dataclasses import dataclass


@dataclass
class Addition:
    kind: str  # the first cell of a row of the table "To add X"
    file: str  # path of the new file; its text is below files/, if `text` does not say otherwise
    list: str  # path of the list
    insertions: list  # (text of the list, text that replaces it); each adds to one line
    list_names: str = ""  # of a list in a header, regular expression: the names that it defines; a file that uses none of them does not depend on its entries
    text: str = ""  # path of the text of the new file, from the root of the tree


def included_after(neighbour, path):
    """The insertion of an include after another one."""
    return (f'#include "{neighbour}"\n', f'#include "{neighbour}"\n#include "{path}"\n')


ADDITIONS = [
    Addition(
        kind="a measure",
        file="src/measure/longest_interval.hpp",
        list="src/measure/measures.cpp",
        insertions=[included_after("measure/intervals.hpp", "measure/longest_interval.hpp"), ("Entrainment>;", "Entrainment, LongestInterval>;")],
    ),
    Addition(
        kind="a recording format",
        file="src/io/table/hexadecimal_table.cpp",
        list="src/io/recording/recording_formats.cpp",
        insertions=[
            ("namespace corpuscle {\n", "namespace corpuscle {\n\nResult<std::unique_ptr<Table>> open_hexadecimal_table(const std::string& path, const TableOptions&);\n"),
            ("open_hdf5_table},\n", 'open_hdf5_table},\n    {"hexadecimal", ".hex", "one hexadecimal integer in each line", open_hexadecimal_table},\n'),
        ],
    ),
    Addition(
        kind="a verb (a command of the program)",
        file="apps/cli/quantity.cpp",
        list="apps/cli/verbs.hpp",
        insertions=[("    VERB(stream)              \\\n", "    VERB(stream)              \\\n    VERB(quantity)            \\\n")],
        list_names="make_verbs",
    ),
    Addition(
        kind="a stimulus",
        file="src/core/stimulus/triangle.hpp",
        list="src/core/stimulus/stimuli.cpp",
        insertions=[included_after("core/stimulus/touch.hpp", "core/stimulus/triangle.hpp"), ("Noise, Grating>;", "Noise, Grating, Triangle>;")],
    ),
    Addition(
        kind="a receptor, a neuron",
        file="src/model/receptor/proportional.hpp",
        list="src/model/models.hpp",
        insertions=[included_after("model/receptor/fa1b.hpp", "model/receptor/proportional.hpp"), ("FastAdapting, SlowlyAdapting>;", "FastAdapting, SlowlyAdapting, Proportional>;")],
        list_names="Receptors|Neurons",
    ),
    Addition(
        kind="a receptor, a neuron",
        file="src/model/neuron/qif.hpp",
        list="src/model/models.hpp",
        insertions=[included_after("model/neuron/lif_b.hpp", "model/neuron/qif.hpp"), ("Adex, Alif>;", "Adex, Alif, Qif>;")],
        list_names="Receptors|Neurons",
        text="examples/own_neuron/qif.hpp",
    ),
    Addition(
        kind="a sensor, a transducer",
        file="src/model/sensor/strain_gauge.hpp",
        list="src/model/components.hpp",
        insertions=[included_after("model/sensor/fsr.hpp", "model/sensor/strain_gauge.hpp"), ("ComponentList<Fsr>;", "ComponentList<Fsr, StrainGauge>;")],
        list_names="Sensors|Transducers|Converters",
    ),
    Addition(
        kind="a netlist device",
        file="src/circuit/device/varistor.cpp",
        list="src/circuit/devices.cpp",
        insertions=[(", transistor_kind;", ", transistor_kind, varistor_kind;"), ("&transistor_kind};", "&transistor_kind, &varistor_kind};")],
        text="examples/own_device/varistor.cpp",
    ),
    Addition(
        kind="a netlist analysis",
        file="src/circuit/analysis/size.cpp",
        list="src/circuit/analyses.cpp",
        insertions=[("tf_analysis, sens_analysis;", "tf_analysis, sens_analysis, size_analysis;"), ("&sens_analysis};", "&sens_analysis, &size_analysis};")],
    ),
    Addition(
        kind="an output format of `respond`",
        file="src/run/sinks/names_file.cpp",
        list="src/run/sinks.cpp",
        insertions=[("trials_format, nwb_format;", "trials_format, nwb_format, names_format;"), ("&nwb_format};", "&nwb_format, &names_format};")],
    ),
]
