// The parts that the Python scripts for all simulators share: reading forces and writing spikes.

#include "run/export/equation_text.hpp"

namespace corpuscle {

const std::string_view python_force_reader = R"py(

def read_force(path, max_step):
    """Reads a CSV file: times (s) in the first column, a force (N) in each other column; names in the first row or none.

    Returns the names, the step (s), the time of the first row, and the forces at multiples of the step, [time, column]. The step divides the
    median interval between rows and is at most max_step. Forces between rows are on straight lines."""
    with open(path, newline="") as file:
        rows = [(number, row) for number, row in enumerate(csv.reader(file), 1) if row]
    if not rows or len(rows[0][1]) < 2:
        sys.exit(f"{path}: expected a column of times in s and at least one column of forces in N, separated by commas")

    def numbers(number, row):
        try:
            values = [float(field) for field in row]
        except ValueError as error:
            sys.exit(f"{path}:{number}: {error}")
        if len(values) != len(rows[0][1]) or not np.all(np.isfinite(values)):
            sys.exit(f"{path}:{number}: expected {len(rows[0][1])} finite numbers, found {','.join(row)}")
        return values

    try:
        float(rows[0][1][0])
        names = [f"ch{column}" for column in range(1, len(rows[0][1]))]
    except ValueError:
        heading = [re.fullmatch(r"\s*(.*?)\s*(?:[(\[]([^)\]]*)[)\]])?\s*", field).groups() for field in rows.pop(0)[1]]
        for (name, unit), expected in zip(heading, ["s"] + ["N"] * len(heading)):
            if unit not in (None, expected):
                sys.exit(f"{path}:1: {name} is in {unit}; convert it to {expected}")
        names = [name for name, unit in heading[1:]]
    table = np.array([numbers(number, row) for number, row in rows])
    if len(table) < 2:
        sys.exit(f"{path}: expected at least two rows of numbers, found {len(table)}")
    times = table[:, 0]
    if np.any(np.diff(times) <= 0):
        row = rows[int(np.argmax(np.diff(times) <= 0)) + 1][0]
        sys.exit(f"{path}:{row}: the time must be later than that of the row before")
    interval = float(np.median(np.diff(times)))
    step = interval / int(np.ceil(interval / max_step - 1e-6))
    grid = times[0] + step * np.arange(int(np.floor((times[-1] - times[0]) / step + 1e-6)) + 1)
    return names, step, float(times[0]), np.stack([np.interp(grid, times, column) for column in table[:, 1:].T], axis=1)


def write_spikes(path, force_path, names, trains):
    """Writes the spike times (s) of each channel in the format of corpuscle's spikes.csv."""
    header = "afferent,channel,time_s\n"
    if os.path.exists(path):
        with open(path, errors="replace") as file:
            if os.path.samefile(path, force_path) or file.readline() not in ("", header):
                sys.exit(f"{path}: exists and is not a file of spikes; choose another name")
    with open(path, "w") as file:
        file.write(header)
        for name, train in zip(names, trains):
            file.writelines(f"{AFFERENT},{name},{time:.9f}\n" for time in sorted(train))


def arguments():
    parser = argparse.ArgumentParser(description=f"Simulates the afferent {AFFERENT}.", allow_abbrev=False)
    parser.add_argument("force", help="CSV file: time (s), then a column of force (N) for each channel")
    parser.add_argument("spikes", nargs="?", default="spikes.csv", help="file for the spikes (default: spikes.csv)")
    parser.add_argument("--step", type=float, default=1e-4, metavar="S", help="longest time step (default: 1e-4 s)")
    given = parser.parse_args()
    if not given.step > 0:
        parser.error("--step: must be greater than 0")
    return given
)py";

}  // namespace corpuscle
