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

#include "circuit/solve/matrix.hpp"

namespace corpuscle::circuit {
namespace {

template <class T, auto free>
struct Freed {
    void operator()(T* p) const { free(p); }
};
using Context = std::unique_ptr<std::remove_pointer_t<SUNContext>, decltype([](SUNContext c) { SUNContext_Free(&c); })>;
using Vector = std::unique_ptr<_generic_N_Vector, Freed<_generic_N_Vector, N_VDestroy>>;
using Matrix = std::unique_ptr<_generic_SUNMatrix, Freed<_generic_SUNMatrix, SUNMatDestroy>>;
using Linear = std::unique_ptr<_generic_SUNLinearSolver, decltype([](SUNLinearSolver s) { SUNLinSolFree(s); })>;
using Ida = std::unique_ptr<void, decltype([](void* m) { IDAFree(&m); })>;

double* of(N_Vector v) { return N_VGetArrayPointer(v); }
double* of(const Vector& v) { return of(v.get()); }

/// The circuit's sums at x, looked at there and nowhere else: a device that shortens its steps is asked until it does not.
class Looked {
    System& system_;
    std::vector<double> memory_;
    EvalContext at_;

public:
    SystemEvaluation sums;
    long evaluations = 0;
    std::size_t watched = 0;
    double level = 0;

    Looked(System& system, double gmin) : system_(system), memory_(system.initial_limiting_state()) { at_.gmin = gmin; }
    std::size_t size() const { return static_cast<std::size_t>(system_.size()); }
    const System& system() const { return system_; }
    bool at(const double* x, double t) {
        at_.time = t;
        for (int k = 0; k < 200; ++k) {
            system_.eval({x, size()}, at_, memory_, sums);
            ++evaluations;
            if (!sums.is_limited) return true;
        }
        return false;
    }
};

int residual(double t, N_Vector y, N_Vector yp, N_Vector r, void* data) {
    auto& looked = *static_cast<Looked*>(data);
    const auto n = looked.size();
    if (!looked.at(of(y), t)) return 1;
    for (std::size_t k = 0; k < n; ++k) {
        of(r)[k] = looked.sums.f[k] + of(yp)[n + k];
        of(r)[n + k] = of(y)[n + k] - looked.sums.q[k];
        if (!std::isfinite(of(r)[k]) || !std::isfinite(of(r)[n + k])) return 1;
    }
    return 0;
}

/// [G  cj; -C  1], column by column
int jacobian(double t, double cj, N_Vector y, N_Vector, N_Vector, SUNMatrix J, void* data, N_Vector, N_Vector, N_Vector) {
    auto& looked = *static_cast<Looked*>(data);
    if (!looked.at(of(y), t)) return 1;
    const auto& pattern = looked.system().pattern();
    const auto n = static_cast<sunindextype>(looked.size());
    auto *begin = SUNSparseMatrix_IndexPointers(J), *rows = SUNSparseMatrix_IndexValues(J);
    double* values = SUNSparseMatrix_Data(J);
    sunindextype at = 0;
    const auto put = [&](sunindextype row, double value) { rows[at] = row, values[at++] = value; };
    for (sunindextype c = 0; c < n; ++c) {
        const auto first = static_cast<std::size_t>(pattern.column_begin()[static_cast<std::size_t>(c)]),
                   last = static_cast<std::size_t>(pattern.column_begin()[static_cast<std::size_t>(c) + 1]);
        begin[c] = at;
        for (auto k = first; k < last; ++k) put(pattern.rows()[k], looked.sums.G[k]);
        for (auto k = first; k < last; ++k) put(n + pattern.rows()[k], -looked.sums.C[k]);
    }
    for (sunindextype c = 0; c < n; ++c) begin[n + c] = at, put(c, cj), put(n + c, 1);
    begin[2 * n] = at;
    return 0;
}

int above_level(double, N_Vector y, N_Vector, double* out, void* data) {
    const auto& looked = *static_cast<Looked*>(data);
    out[0] = of(y)[looked.watched] - looked.level;
    return 0;
}

SUNContext made_context() {
    SUNContext c = nullptr;
#ifdef SUN_COMM_NULL
    SUNContext_Create(SUN_COMM_NULL, &c);
#else  // before SUNDIALS 7
    SUNContext_Create(nullptr, &c);
#endif
    return c;
}

class Run {
    Looked looked_;
    const IdaOptions& asked_;
    std::size_t n_;
    Context context_;
    Vector y_, slope_, floor_;
    Matrix matrix_;
    Linear linear_;
    Ida ida_;
    double t_ = 0;
    std::size_t next_ = 0;  // of the times asked for
    IdaResult out_;

    bool done(int flag, const char* what) {
        if (flag < 0)
            out_.error =
                fmt::format("{} at {:.9g} s: {}", what, t_, std::unique_ptr<char, Freed<void, free>>(IDAGetReturnFlagName(flag)).get());
        return flag >= 0;
    }
    void floors();
    bool settle(double h);
    bool begin();
    bool go_to(double corner);

public:
    Run(System&, double gmin, const std::vector<double>& start, const IdaOptions&);
    IdaResult whole();
};

Run::Run(System& system, double gmin, const std::vector<double>& start, const IdaOptions& asked)
    : looked_(system, gmin), asked_(asked), n_(looked_.size()), context_(made_context()) {
    const auto count = static_cast<sunindextype>(2 * n_), entries = static_cast<sunindextype>(2 * system.pattern().entries() + 2 * n_);
    for (auto* v : {&y_, &slope_, &floor_}) v->reset(N_VNew_Serial(count, context_.get())), N_VConst(0, v->get());
    std::copy(start.begin(), start.end(), of(y_));
    matrix_.reset(SUNSparseMatrix(count, count, entries, CSC_MAT, context_.get()));
    linear_.reset(SUNLinSol_KLU(y_.get(), matrix_.get(), context_.get()));
    if (asked.crossing_unknown >= 0) looked_.watched = static_cast<std::size_t>(asked.crossing_unknown), looked_.level = asked.crossing_level;
}

/// What is small: vntol, and a node's capacitance times it. Currents are let go.
void Run::floors() {
    const auto& system = looked_.system();
    for (std::size_t k = 0; k < n_; ++k) {
        const double c = std::abs(looked_.sums.C[system.pattern().entry_index(static_cast<int>(k), static_cast<int>(k))]);
        of(floor_)[k] = system.is_voltage(static_cast<int>(k)) ? asked_.vntol : 1;
        of(floor_)[n_ + k] = c > 0 ? c * asked_.vntol : 1;
    }
}

/// One step of backward Euler, so short that nothing charged moves: all else finds its place. Then dq/dt = -f.
bool Run::settle(double h) {
    const auto& pattern = looked_.system().pattern();
    LinearSolver<double> solver(pattern);
    double* x = of(y_);
    if (!looked_.at(x, t_)) return false;
    const auto before = looked_.sums.q;
    auto& s = looked_.sums;
    std::vector<double> step(n_);
    double most = 1;
    for (int k = 0; k < 100 && most > 1e-11; ++k) {
        if (!looked_.at(x, t_ + h)) return false;
        for (std::size_t j = 0; j < n_; ++j) step[j] = -(s.f[j] + (s.q[j] - before[j]) / h);
        auto values = s.G;
        for (std::size_t j = 0; j < values.size(); ++j) values[j] += s.C[j] / h;
        if (!solver.factor(std::span<const double>(values).first(pattern.entries()))) return false;
        solver.solve(step);
        most = 0;
        for (std::size_t j = 0; j < n_; ++j) {
            const bool voltage = looked_.system().is_voltage(static_cast<int>(j));
            if (voltage) most = std::max(most, std::abs(step[j]));
            x[j] += voltage ? std::clamp(step[j], -0.3, 0.3) : step[j];
        }
    }
    t_ += h;
    if (most > 1e-11 || !looked_.at(x, t_)) return false;
    for (std::size_t j = 0; j < n_; ++j) of(slope_)[j] = 0, of(slope_)[n_ + j] = -s.f[j], of(y_)[n_ + j] = s.q[j];
    return true;
}

bool Run::begin() {
    floors();
    if (ida_) return done(IDAReInit(ida_.get(), t_, y_.get(), slope_.get()), "beginning anew");
    ida_.reset(IDACreate(context_.get()));
    void* m = ida_.get();
    return done(IDAInit(m, residual, t_, y_.get(), slope_.get()), "init") &&
           done(IDASVtolerances(m, asked_.reltol, floor_.get()), "tolerances") && done(IDASetUserData(m, &looked_), "data") &&
           done(IDASetLinearSolver(m, linear_.get(), matrix_.get()), "linear solver") && done(IDASetJacFn(m, jacobian), "slopes") &&
           done(IDASetMaxNumSteps(m, asked_.max_steps), "steps") && done(IDASetMaxErrTestFails(m, 50), "fails") &&
           done(IDASetMaxConvFails(m, 50), "fails") && (asked_.crossing_unknown < 0 || done(IDARootInit(m, 1, above_level), "watching"));
}

bool Run::go_to(double corner) {
    void* m = ida_.get();
    if (!done(IDASetStopTime(m, corner), "stop")) return false;
    int upward = 1;
    if (asked_.crossing_unknown >= 0 && !done(IDASetRootDirection(m, &upward), "watching")) return false;
    while (t_ < corner) {
        const bool wanted = next_ < asked_.output_times.size() && asked_.output_times[next_] <= corner;
        const int flag = IDASolve(m, wanted ? asked_.output_times[next_] : corner, &t_, y_.get(), slope_.get(), IDA_NORMAL);
        if (!done(flag, "a step")) return false;
        if (flag == IDA_ROOT_RETURN) out_.crossings.push_back(t_);
        for (; flag != IDA_ROOT_RETURN && next_ < asked_.output_times.size() && asked_.output_times[next_] <= t_; ++next_)
            out_.x.emplace_back(of(y_), of(y_) + n_);
    }
    long steps = 0;
    IDAGetNumSteps(m, &steps);
    out_.steps += steps;
    return true;
}

IdaResult Run::whole() {
    for (; next_ < asked_.output_times.size() && asked_.output_times[next_] <= 0; ++next_) out_.x.emplace_back(of(y_), of(y_) + n_);
    while (t_ < asked_.stop) {
        double corner = looked_.system().next_breakpoint(t_ + 1e-12 * asked_.stop);  // the same corner, rounded otherwise, is none
        if (corner > asked_.stop * (1 - 1e-12)) corner = asked_.stop;
        if (!settle(std::min(1e-12 * asked_.stop, 1e-6 * (corner - t_)))) {
            out_.error = fmt::format("nothing settles at {:.9g} s", t_);
            break;
        }
        if (!begin() || !go_to(corner)) break;
    }
    out_.evaluations = looked_.evaluations;
    return std::move(out_);
}

}  // namespace

IdaResult integrate_with_ida(System& system, double gmin, const std::vector<double>& start, const IdaOptions& asked) {
    system.start_transient(asked.step, asked.stop);
    auto answer = Run(system, gmin, start, asked).whole();
    system.start_transient(0, 0);
    return answer;
}

}  // namespace corpuscle::circuit
