// The only file that uses MPI.

#include "run/ranks.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <list>
#include <vector>

#ifdef CORPUSCLE_MPI
#include <dlfcn.h>
#include <mpi.h>
#endif

namespace corpuscle {
namespace {

/// An integer environment variable set by a launcher; -1 if it is not set.
int launcher_variable(const char* name) {
    const char* text = std::getenv(name);
    return text ? std::atoi(text) : -1;
}

}  // namespace

bool Ranks::are_started() {
    const int size = launcher_variable("OMPI_COMM_WORLD_SIZE");
    return size > 1 || (size < 0 && launcher_variable("PMIX_RANK") >= 0);
}

bool Ranks::reports_errors() { return launcher_variable("OMPI_COMM_WORLD_RANK") <= 0 && launcher_variable("PMIX_RANK") <= 0; }

#ifdef CORPUSCLE_MPI

namespace {

/// MPI's functions, loaded by name from its library. Only types and constants come from the header.
struct Mpi {
    decltype(&MPI_Init) init = nullptr;
    decltype(&MPI_Comm_rank) rank = nullptr;
    decltype(&MPI_Comm_size) size = nullptr;
    decltype(&MPI_Comm_set_errhandler) set_errhandler = nullptr;
    decltype(&MPI_Isend) isend = nullptr;
    decltype(&MPI_Improbe) improbe = nullptr;
    decltype(&MPI_Imrecv) imrecv = nullptr;
    decltype(&MPI_Test) test = nullptr;
    decltype(&MPI_Get_count) count = nullptr;
    decltype(&MPI_Finalize) finalize = nullptr;
    MPI_Comm world = {};
    MPI_Errhandler errors_return = {};
    MPI_Datatype byte = {};
    std::string missing;  ///< why the library cannot be loaded, or a function that it lacks; empty if all is loaded

    Mpi() {
        void* library = nullptr;
        for (const char* name : {"libmpi.so.40", "libmpi.so"})
            if (!library) library = ::dlopen(name, RTLD_NOW | RTLD_GLOBAL);
        if (!library) {
            missing = ::dlerror();
            return;
        }
        const auto find = [&](auto& into, const char* name) {
            void* symbol = ::dlsym(library, name);
            if (!symbol) missing = name;
            std::memcpy(&into, &symbol, sizeof into);
        };
        find(init, "MPI_Init"), find(rank, "MPI_Comm_rank"), find(size, "MPI_Comm_size"), find(set_errhandler, "MPI_Comm_set_errhandler");
        find(isend, "MPI_Isend"), find(improbe, "MPI_Improbe"), find(imrecv, "MPI_Imrecv"), find(test, "MPI_Test");
        find(count, "MPI_Get_count"), find(finalize, "MPI_Finalize");
#ifdef OPEN_MPI  // Open MPI's constants are objects of the library
        find(world, "ompi_mpi_comm_world"), find(errors_return, "ompi_mpi_errors_return"), find(byte, "ompi_mpi_byte");
#else
        world = MPI_COMM_WORLD, errors_return = MPI_ERRORS_RETURN, byte = MPI_BYTE;
#endif
    }
};

/// A message that is being sent or received. Its bytes must not move in memory.
struct PendingMessage {
    int rank;  ///< of the receiver or the sender
    std::string bytes;
    MPI_Request request;
};

}  // namespace

struct Ranks::Impl {
    Mpi mpi;
    int rank = 0, size = 1;
    std::list<PendingMessage> sending, receiving;

    enum class State { in_progress, complete, failed };
    State state(PendingMessage& m) {
        int done = 0;
        if (mpi.test(&m.request, &done, MPI_STATUS_IGNORE) != MPI_SUCCESS) return State::failed;
        return done ? State::complete : State::in_progress;
    }
    /// Starts to receive all messages that have arrived.
    void begin_receiving();
};

Result<std::unique_ptr<Ranks>> Ranks::join() {
    auto impl = std::make_unique<Impl>();
    auto& mpi = impl->mpi;
    if (!mpi.missing.empty())
        return bad_input(
            fmt::format("started by mpirun, but the MPI library cannot be loaded here ({}); install OpenMPI, or start it "
                        "without mpirun: -j for the cores of one machine, --shard and 'corpuscle sweep merge' for several",
                        mpi.missing));
    // With Open MPI's single-copy transfer, the receiver would read a large message from the memory of the sender, which may have died.
    ::setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);
    if (mpi.init(nullptr, nullptr) != MPI_SUCCESS) return bad_input("MPI_Init failed; see its message above");
    mpi.set_errhandler(mpi.world, mpi.errors_return);
    mpi.rank(mpi.world, &impl->rank);
    mpi.size(mpi.world, &impl->size);
    return std::unique_ptr<Ranks>(new Ranks(std::move(impl)));
}

void Ranks::Impl::begin_receiving() {
    for (;;) {
        int is_available = 0;
        MPI_Message found = {};
        MPI_Status status = {};
        if (mpi.improbe(MPI_ANY_SOURCE, 0, mpi.world, &is_available, &found, &status) != MPI_SUCCESS || !is_available) return;
        int bytes = 0;
        mpi.count(&status, mpi.byte, &bytes);
        auto& m = receiving.emplace_back(PendingMessage{status.MPI_SOURCE, std::string(static_cast<std::size_t>(bytes), '\0'), {}});
        if (mpi.imrecv(m.bytes.data(), bytes, mpi.byte, &found, &m.request) != MPI_SUCCESS) receiving.pop_back();
    }
}

int Ranks::rank() const { return impl_->rank; }
int Ranks::size() const { return impl_->size; }

bool Ranks::survive_death_of_one() const {
    return launcher_variable("OMPI_COMM_WORLD_SIZE") < 0 || launcher_variable("OMPI_MCA_orte_enable_recovery") == 1;
}

void Ranks::send(int to, std::string message) {
    auto& m = impl_->sending.emplace_back(PendingMessage{to, std::move(message), {}});
    const auto& mpi = impl_->mpi;
    if (mpi.isend(m.bytes.data(), static_cast<int>(m.bytes.size()), mpi.byte, to, 0, mpi.world, &m.request) != MPI_SUCCESS)
        impl_->sending.pop_back();
}

std::size_t Ranks::unsent() const {
    impl_->sending.remove_if([&](PendingMessage& m) { return impl_->state(m) != Impl::State::in_progress; });
    return impl_->sending.size();
}

std::optional<Ranks::Received> Ranks::receive() {
    impl_->begin_receiving();
    std::vector<int> incomplete;  // senders of an incomplete message; their later messages must wait
    for (auto m = impl_->receiving.begin(); m != impl_->receiving.end();) {
        const auto current = m++;
        if (std::find(incomplete.begin(), incomplete.end(), current->rank) != incomplete.end()) continue;
        const auto state = impl_->state(*current);
        if (state == Impl::State::in_progress) {
            incomplete.push_back(current->rank);
            continue;
        }
        Received out{current->rank, std::move(current->bytes)};
        impl_->receiving.erase(current);
        if (state == Impl::State::complete) return out;
    }
    return {};
}

// MPI may still use the buffers of these messages, so they are never freed.
void Ranks::drop_messages_of(int rank) {
    static std::list<PendingMessage> forgotten;
    for (auto* all : {&impl_->sending, &impl_->receiving})
        for (auto m = all->begin(); m != all->end();) {
            const auto current = m++;
            if (current->rank == rank) forgotten.splice(forgotten.end(), *all, current);
        }
}

void Ranks::leave(bool together) {
    left_together_ = together;
    if (together) impl_->mpi.finalize();
}

#else

struct Ranks::Impl {};

Result<std::unique_ptr<Ranks>> Ranks::join() {
    return bad_input(
        "started by mpirun, but this corpuscle was built without MPI; build it where OpenMPI is installed (libopenmpi-dev), or start "
        "it without mpirun: -j for the cores of one machine, --shard and 'corpuscle sweep merge' for several");
}
int Ranks::rank() const { return 0; }
int Ranks::size() const { return 1; }
bool Ranks::survive_death_of_one() const { return true; }
void Ranks::send(int, std::string) {}
std::size_t Ranks::unsent() const { return 0; }
std::optional<Ranks::Received> Ranks::receive() { return {}; }
void Ranks::drop_messages_of(int) {}
void Ranks::leave(bool) {}

#endif

Ranks::Ranks(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Ranks::~Ranks() = default;

}  // namespace corpuscle
