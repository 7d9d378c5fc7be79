#include "circuit/ida_integrator.hpp"

#include <fmt/format.h>
#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>

#include "circuit/solve/linear/matrix.hpp"

namespace corpuscle::circuit {
namespace {

template <class T, auto free>
struct Deleter {
    void operator()(T* p) const { free(p); }
};
using Context = std::unique_ptr<std::remove_pointer_t<SUNContext>, decltype([](SUNContext c) { SUNContext_Free(&c); })>;
using Vector = std::unique_ptr<_generic_N_Vector, Deleter<_generic_N_Vector, N_VDestroy>>;
using Matrix = std::unique_ptr<_generic_SUNMatrix, Deleter<_generic_SUNMatrix, SUNMatDestroy>>;
using Linear = std::unique_ptr<_generic_SUNLinearSolver, decltype([](SUNLinearSolver s) { SUNLinSolFree(s); })>;
using Ida = std::unique_ptr<void, decltype([](void* m) { IDAFree(&m); })>;

double* data_of(N_Vector v) { return N_VGetArrayPointer(v); }
double* data_of(const Vector& v) { return data_of(v.get()); }

/// Evaluates the circuit's equations exactly at x: repeats the evaluation until no device limits its voltages.
class EquationEvaluator {
    System& system_;
    std::vector<double> memory_;
    EvalContext eval_context_;

public:
    SystemEvaluation sums;
    long evaluations = 0;
    std::size_t crossing_unknown = 0;
    double crossing_level = 0;  // V

    EquationEvaluator(System& system, double gmin) : system_(system), memory_(system.initial_limiting_state()) {
        eval_context_.gmin = gmin;
    }
    std::size_t size() const { return static_cast<std::size_t>(system_.size()); }
    const System& system() const { return system_; }
    bool evaluate(const double* x, double t) {
        eval_context_.time = t;
        for (int k = 0; k < 200; ++k) {
            system_.eval({x, size()}, eval_context_, memory_, sums);
            ++evaluations;
            if (!sums.is_limited) return true;
        }
        return false;
    }
};

int residual(double t, N_Vector y, N_Vector yp, N_Vector r, void* data) {
    auto& equations = *static_cast<EquationEvaluator*>(data);
    const auto n = equations.size();
    if (!equations.evaluate(data_of(y), t)) return 1;
    for (std::size_t k = 0; k < n; ++k) {
        data_of(r)[k] = equations.sums.f[k] + data_of(yp)[n + k];
        data_of(r)[n + k] = data_of(y)[n + k] - equations.sums.q[k];
        if (!std::isfinite(data_of(r)[k]) || !std::isfinite(data_of(r)[n + k])) return 1;
    }
    return 0;
}

/// Jacobian [G  cj; -C  1] in the unknowns (x, q), column by column.
int jacobian(double t, double cj, N_Vector y, N_Vector, N_Vector, SUNMatrix J, void* data, N_Vector, N_Vector, N_Vector) {
    auto& equations = *static_cast<EquationEvaluator*>(data);
    if (!equations.evaluate(data_of(y), t)) return 1;
    const auto& pattern = equations.system().pattern();
    const auto n = static_cast<sunindextype>(equations.size());
    auto *begin = SUNSparseMatrix_IndexPointers(J), *rows = SUNSparseMatrix_IndexValues(J);
    double* values = SUNSparseMatrix_Data(J);
    sunindextype at = 0;
    const auto put = [&](sunindextype row, double value) { rows[at] = row, values[at++] = value; };
    for (sunindextype c = 0; c < n; ++c) {
        const auto first = static_cast<std::size_t>(pattern.column_begin()[static_cast<std::size_t>(c)]),
                   last = static_cast<std::size_t>(pattern.column_begin()[static_cast<std::size_t>(c) + 1]);
        begin[c] = at;
        for (auto k = first; k < last; ++k) put(pattern.rows()[k], equations.sums.G[k]);
        for (auto k = first; k < last; ++k) put(n + pattern.rows()[k], -equations.sums.C[k]);
    }
    for (sunindextype c = 0; c < n; ++c) begin[n + c] = at, put(c, cj), put(n + c, 1);
    begin[2 * n] = at;
    return 0;
}

int above_level(double, N_Vector y, N_Vector, double* out, void* data) {
    const auto& equations = *static_cast<EquationEvaluator*>(data);
    out[0] = data_of(y)[equations.crossing_unknown] - equations.crossing_level;
    return 0;
}

SUNContext make_context() {
    SUNContext c = nullptr;
#ifdef SUN_COMM_NULL
    SUNContext_Create(SUN_COMM_NULL, &c);
#else  // before SUNDIALS 7
    SUNContext_Create(nullptr, &c);
#endif
    return c;
}

class Run {
    EquationEvaluator equations_;
    const IdaOptions& options_;
    std::size_t n_;
    Context context_;
    Vector y_, slope_, tolerances_;
    Matrix matrix_;
    Linear linear_;
    Ida ida_;
    double t_ = 0;
    std::size_t next_ = 0;  // index into the output times
    IdaResult out_;

    /// False after an error, which is stored in the result. `what` names the call.
    bool check(int flag, const char* what) {
        if (flag < 0)
            out_.error =
                fmt::format("{} at {:.9g} s: {}", what, t_, std::unique_ptr<char, Deleter<void, free>>(IDAGetReturnFlagName(flag)).get());
        return flag >= 0;
    }
    void set_tolerances();
    bool make_consistent(double h);
    bool start();
    bool advance_to(double breakpoint);

public:
    Run(System&, double gmin, const std::vector<double>& start, const IdaOptions&);
    IdaResult integrate();
};

Run::Run(System& system, double gmin, const std::vector<double>& start, const IdaOptions& options)
    : equations_(system, gmin), options_(options), n_(equations_.size()), context_(make_context()) {
    const auto count = static_cast<sunindextype>(2 * n_), entries = static_cast<sunindextype>(2 * system.pattern().entries() + 2 * n_);
    for (auto* v : {&y_, &slope_, &tolerances_}) v->reset(N_VNew_Serial(count, context_.get())), N_VConst(0, v->get());
    std::copy(start.begin(), start.end(), data_of(y_));
    matrix_.reset(SUNSparseMatrix(count, count, entries, CSC_MAT, context_.get()));
    linear_.reset(SUNLinSol_KLU(y_.get(), matrix_.get(), context_.get()));
    if (options.crossing_unknown >= 0)
        equations_.crossing_unknown = static_cast<std::size_t>(options.crossing_unknown),
        equations_.crossing_level = options.crossing_level;
}

/// Absolute tolerances: vntol for voltages, a node's capacitance times vntol for charges. Currents are not checked.
void Run::set_tolerances() {
    const auto& system = equations_.system();
    for (std::size_t k = 0; k < n_; ++k) {
        const double c = std::abs(equations_.sums.C[system.pattern().entry_index(static_cast<int>(k), static_cast<int>(k))]);
        data_of(tolerances_)[k] = system.is_voltage(static_cast<int>(k)) ? options_.vntol : 1;
        data_of(tolerances_)[n_ + k] = c > 0 ? c * options_.vntol : 1;
    }
}

/// Makes all unknowns consistent with the charges, by one step of backward Euler that is too short to change them. Then sets dq/dt = -f.
bool Run::make_consistent(double h) {
    const auto& pattern = equations_.system().pattern();
    LinearSolver<double> solver(pattern);
    double* x = data_of(y_);
    if (!equations_.evaluate(x, t_)) return false;
    const auto before = equations_.sums.q;
    auto& s = equations_.sums;
    std::vector<double> step(n_);
    double largest = 1;
    for (int k = 0; k < 100 && largest > 1e-11; ++k) {
        if (!equations_.evaluate(x, t_ + h)) return false;
        for (std::size_t j = 0; j < n_; ++j) step[j] = -(s.f[j] + (s.q[j] - before[j]) / h);
        auto values = s.G;
        for (std::size_t j = 0; j < values.size(); ++j) values[j] += s.C[j] / h;
        if (!solver.factor(std::span<const double>(values).first(pattern.entries()))) return false;
        solver.solve(step);
        largest = 0;
        for (std::size_t j = 0; j < n_; ++j) {
            const bool voltage = equations_.system().is_voltage(static_cast<int>(j));
            if (voltage) largest = std::max(largest, std::abs(step[j]));
            x[j] += voltage ? std::clamp(step[j], -0.3, 0.3) : step[j];
        }
    }
    t_ += h;
    if (largest > 1e-11 || !equations_.evaluate(x, t_)) return false;
    for (std::size_t j = 0; j < n_; ++j) data_of(slope_)[j] = 0, data_of(slope_)[n_ + j] = -s.f[j], data_of(y_)[n_ + j] = s.q[j];
    return true;
}

bool Run::start() {
    set_tolerances();
    if (ida_) return check(IDAReInit(ida_.get(), t_, y_.get(), slope_.get()), "reinit");
    ida_.reset(IDACreate(context_.get()));
    void* m = ida_.get();
    return check(IDAInit(m, residual, t_, y_.get(), slope_.get()), "init") &&
           check(IDASVtolerances(m, options_.reltol, tolerances_.get()), "tolerances") && check(IDASetUserData(m, &equations_), "data") &&
           check(IDASetLinearSolver(m, linear_.get(), matrix_.get()), "linear solver") && check(IDASetJacFn(m, jacobian), "Jacobian") &&
           check(IDASetMaxNumSteps(m, options_.max_steps), "steps") && check(IDASetMaxErrTestFails(m, 50), "fails") &&
           check(IDASetMaxConvFails(m, 50), "fails") && (options_.crossing_unknown < 0 || check(IDARootInit(m, 1, above_level), "root"));
}

bool Run::advance_to(double breakpoint) {
    void* m = ida_.get();
    if (!check(IDASetStopTime(m, breakpoint), "stop")) return false;
    int upward = 1;
    if (options_.crossing_unknown >= 0 && !check(IDASetRootDirection(m, &upward), "root")) return false;
    while (t_ < breakpoint) {
        const bool has_output = next_ < options_.output_times.size() && options_.output_times[next_] <= breakpoint;
        const int flag = IDASolve(m, has_output ? options_.output_times[next_] : breakpoint, &t_, y_.get(), slope_.get(), IDA_NORMAL);
        if (!check(flag, "a step")) return false;
        if (flag == IDA_ROOT_RETURN) out_.crossings.push_back(t_);
        for (; flag != IDA_ROOT_RETURN && next_ < options_.output_times.size() && options_.output_times[next_] <= t_; ++next_)
            out_.x.emplace_back(data_of(y_), data_of(y_) + n_);
    }
    long steps = 0;
    IDAGetNumSteps(m, &steps);
    out_.steps += steps;
    return true;
}

IdaResult Run::integrate() {
    for (; next_ < options_.output_times.size() && options_.output_times[next_] <= 0; ++next_)
        out_.x.emplace_back(data_of(y_), data_of(y_) + n_);
    while (t_ < options_.stop) {
        double breakpoint = equations_.system().next_breakpoint(t_ + 1e-12 * options_.stop);  // skips the current one
        if (breakpoint > options_.stop * (1 - 1e-12)) breakpoint = options_.stop;
        if (!make_consistent(std::min(1e-12 * options_.stop, 1e-6 * (breakpoint - t_)))) {
            out_.error = fmt::format("no consistent state at {:.9g} s", t_);
            break;
        }
        if (!start() || !advance_to(breakpoint)) break;
    }
    out_.evaluations = equations_.evaluations;
    return std::move(out_);
}

}  // namespace

IdaResult integrate_with_ida(System& system, double gmin, const std::vector<double>& start, const IdaOptions& options) {
    system.start_transient(options.step, options.stop);
    auto result = Run(system, gmin, start, options).integrate();
    system.start_transient(0, 0);
    return result;
}

}  // namespace corpuscle::circuit
