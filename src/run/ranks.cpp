// The only file that uses MPI.

#include "run/ranks.hpp"

#include <cstdlib>
#include <exception>
#include <new>

#ifdef CORPUSCLE_MPI
#include <dlfcn.h>
#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <limits>
#include <thread>
#include <utility>
#endif

namespace corpuscle {
namespace {

/// An integer environment variable set by a launcher; -1 if it is not set.
int launcher_variable(const char* name) {
    const char* text = std::getenv(name);
    return text ? std::atoi(text) : -1;
}

/// True if a launcher started more than one process.
bool are_started() {
    const int size = launcher_variable("OMPI_COMM_WORLD_SIZE");
    return size > 1 || (size < 0 && launcher_variable("PMIX_RANK") >= 0);
}

}  // namespace

Result<void> without_exceptions(const std::function<Result<void>()>& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return bad_input("not enough memory; use fewer ranks on this machine, or fewer afferents, sites or samples at a time");
    } catch (const std::exception& e) {
        return bad_input(e.what());
    }
}

bool Ranks::reports_errors() { return launcher_variable("OMPI_COMM_WORLD_RANK") <= 0 && launcher_variable("PMIX_RANK") <= 0; }

#ifdef OPEN_MPI  // defined by its mpi.h; other MPI libraries have other constants

namespace {

/// The address of a function or constant of the MPI library; null if there is none. The library is loaded here and not linked: a linked
/// program would not start on a machine without it, and start 1 ms (a fifth) later on any other.
void* address_in_mpi(const char* name) {
    static void* const library = ::dlopen("libmpi.so.40", RTLD_NOW | RTLD_GLOBAL);
    return library ? ::dlsym(library, name) : nullptr;
}

/// A function of the MPI library. Errors in it end all ranks (MPI's default), so their results are not checked.
#define CORPUSCLE_MPI_FUNCTION(name) reinterpret_cast<decltype(&name)>(address_in_mpi(#name))

MPI_Comm world() { return static_cast<MPI_Comm>(address_in_mpi("ompi_mpi_comm_world")); }
MPI_Datatype byte() { return static_cast<MPI_Datatype>(address_in_mpi("ompi_mpi_byte")); }

constexpr int message_tag = 0, error_tag = 1;

/// Calls `is_done` until it returns true or this time (s) has passed. Returns its last result. After the first moments it sleeps between
/// the calls: MPI's own waiting would keep a processor busy.
template <class IsDone>
bool wait_until(const IsDone& is_done, double seconds = std::numeric_limits<double>::infinity()) {
    using Clock = std::chrono::steady_clock;
    constexpr Clock::duration busy = std::chrono::microseconds(200), longest_sleep = std::chrono::milliseconds(1);
    const auto start = Clock::now();
    while (!is_done()) {
        const auto waited = Clock::now() - start;
        if (std::chrono::duration<double>(waited).count() > seconds) return false;
        if (waited < busy)
            std::this_thread::yield();
        else
            std::this_thread::sleep_for(std::min(waited / 4, longest_sleep));
    }
    return true;
}

bool is_complete(MPI_Request& request) {
    int complete = 0;
    CORPUSCLE_MPI_FUNCTION(MPI_Test)(&request, &complete, MPI_STATUS_IGNORE);
    return complete != 0;
}

class MpiRanks final : public Ranks {
    /// A message that begins to arrive. Its bytes must not move in memory.
    struct Arriving {
        std::string bytes;
        int from, tag;
        MPI_Request request;
    };
    int rank_ = 0, size_ = 1;
    std::optional<Arriving> arriving_;

    void send_with_tag(int to, const std::string& bytes, int tag) {
        MPI_Request request = {};
        CORPUSCLE_MPI_FUNCTION(MPI_Issend)(bytes.data(), static_cast<int>(bytes.size()), byte(), to, tag, world(), &request);
        wait_until([&] { return is_complete(request); });
    }

    /// `from`: a rank, or MPI_ANY_SOURCE.
    void begin_receiving(int from) {
        int has_arrived = 0, size = 0;
        MPI_Status status = {};
        CORPUSCLE_MPI_FUNCTION(MPI_Iprobe)(from, MPI_ANY_TAG, world(), &has_arrived, &status);
        if (!has_arrived) return;
        CORPUSCLE_MPI_FUNCTION(MPI_Get_count)(&status, byte(), &size);
        auto& a = arriving_.emplace(Arriving{std::string(static_cast<std::size_t>(size), '\0'), status.MPI_SOURCE, status.MPI_TAG, {}});
        CORPUSCLE_MPI_FUNCTION(MPI_Irecv)(a.bytes.data(), size, byte(), a.from, a.tag, world(), &a.request);
    }

    bool has_arrived() { return arriving_ && is_complete(arriving_->request); }

    Received take_arrived() {
        auto arrived = *std::exchange(arriving_, std::nullopt);
        if (arrived.tag == message_tag) return {arrived.from, std::move(arrived.bytes)};
        return {arrived.from, Error{static_cast<ErrorCode>(static_cast<unsigned char>(arrived.bytes[0])), arrived.bytes.substr(1)}};
    }

public:
    MpiRanks() {
        // Turns off the single copy, with which the receiver reads a large message from the memory of the sender. Some containers do not
        // allow it, and it fails if the sender has been killed.
        ::setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);  // Open MPI 4
        ::setenv("OMPI_MCA_smsc", "^cma,knem,xpmem", 0);                  // Open MPI 5
        int provided = 0;
        CORPUSCLE_MPI_FUNCTION(MPI_Init_thread)(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
        CORPUSCLE_MPI_FUNCTION(MPI_Comm_rank)(world(), &rank_);
        CORPUSCLE_MPI_FUNCTION(MPI_Comm_size)(world(), &size_);
    }
    ~MpiRanks() override { CORPUSCLE_MPI_FUNCTION(MPI_Finalize)(); }

    int rank() const override { return rank_; }
    int size() const override { return size_; }
    void send(int to, const std::string& message) override { send_with_tag(to, message, message_tag); }
    void send_error(const Error& error) override {
        std::array<char, 256> host = {};
        ::gethostname(host.data(), host.size() - 1);
        send_with_tag(0, fmt::format("{}rank {} on {}: {}", static_cast<char>(error.code), rank_, host.data(), error.text()), error_tag);
    }
    std::optional<Received> receive_any() override {
        constexpr double longest_arrival = 0.1;  // s; after this time the caller can do something else, and then continue to wait
        if (!arriving_) begin_receiving(MPI_ANY_SOURCE);
        if (!arriving_ || !wait_until([&] { return has_arrived(); }, longest_arrival)) return {};
        return take_arrived();
    }
    Result<std::string> receive(int from) override {
        wait_until([&] {
            if (!arriving_) begin_receiving(from);
            return has_arrived();
        });
        return take_arrived().message;
    }
    [[noreturn]] void abort(int exit_status) override {
        std::fflush(nullptr);
        CORPUSCLE_MPI_FUNCTION(MPI_Abort)(world(), exit_status);
        std::_Exit(exit_status);  // MPI_Abort returns if it cannot end the other ranks
    }
};

}  // namespace

Result<std::unique_ptr<Ranks>> Ranks::join() {
    if (!are_started()) return std::unique_ptr<Ranks>();
    if (!address_in_mpi("MPI_Init_thread"))
        return bad_input(
            fmt::format("started by mpirun, but the MPI library cannot be loaded here ({}); install OpenMPI, or start it "
                        "without mpirun: -j for the cores of one machine, --shard and 'corpuscle sweep merge' for several",
                        ::dlerror()));
    if (launcher_variable("OMPI_MCA_orte_enable_recovery") == 1)
        return bad_usage(
            "mpirun --enable-recovery: the other ranks would wait for ever for one that has died; leave the option out: mpirun then ends "
            "all ranks, and the same command resumes a sweep");
    auto ranks = std::make_unique<MpiRanks>();
    return ranks->size() > 1 ? std::unique_ptr<Ranks>(std::move(ranks)) : nullptr;
}

#else

Result<std::unique_ptr<Ranks>> Ranks::join() {
    if (!are_started()) return std::unique_ptr<Ranks>();
    return bad_input(
        "started by mpirun, but this corpuscle was built without MPI; build it where OpenMPI is installed (libopenmpi-dev), or start "
        "it without mpirun: -j for the cores of one machine, --shard and 'corpuscle sweep merge' for several");
}

#endif

}  // namespace corpuscle
