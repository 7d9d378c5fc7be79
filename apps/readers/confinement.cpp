// The rights that a helper program gives up before it reads the first byte of a file.

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>

#include "helper_main.hpp"

namespace corpuscle {
namespace {

/// The address space that this process uses, bytes; 0 if it is unknown. A limit below it would make every allocation fail.
std::uint64_t address_space_in_use() {
    unsigned long long pages = 0;
    if (std::FILE* f = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(f, "%llu", &pages) != 1) pages = 0;
        std::fclose(f);
    }
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// Lowers the soft and the hard limit of a resource to `limit`; never raises them.
void lower(__rlimit_resource resource, std::uint64_t limit) {
    rlimit now{};
    if (::getrlimit(resource, &now) != 0) return;
    const rlimit lowered{std::min<rlim_t>(now.rlim_cur, limit), std::min<rlim_t>(now.rlim_max, limit)};
    (void)::setrlimit(resource, &lowered);
}

/// Forbids opening, creating and removing files at any path: all rights of Landlock ABI 1, without exceptions. Does nothing if the kernel
/// has no Landlock.
void forbid_paths() {
    landlock_ruleset_attr controlled{};                                  // no rules follow, so every controlled access is denied
    controlled.handled_access_fs = LANDLOCK_ACCESS_FS_MAKE_SYM * 2 - 1;  // the 13 rights of ABI 1 are the lowest bits
    const long rules = ::syscall(SYS_landlock_create_ruleset, &controlled, sizeof controlled.handled_access_fs, 0);
    if (rules < 0) return;
    (void)::syscall(SYS_landlock_restrict_self, rules, 0);
    ::close(static_cast<int>(rules));
}

#if defined(__x86_64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#elif defined(__riscv) && __riscv_xlen == 64
constexpr std::uint32_t architecture = AUDIT_ARCH_RISCV64;
#else
constexpr std::uint32_t architecture = 0;  // unknown: system calls are not restricted
#endif

/// System calls for memory, time, exit, and reading and writing the open descriptors. Any other call fails with EPERM. newfstatat is
/// allowed because the C library's fstat may use it; called with a path, it reveals whether a file exists, and its size.
constexpr long allowed[] = {SYS_read,       SYS_pread64,      SYS_readv,          SYS_write,        SYS_writev,      SYS_lseek,
                            SYS_close,      SYS_fstat,        SYS_sendto,         SYS_recvfrom,
#ifdef SYS_newfstatat
                            SYS_newfstatat,
#endif
#ifdef SYS_alarm
                            SYS_alarm,
#endif
#ifdef SYS_time
                            SYS_time,
#endif
                            SYS_setitimer,  SYS_brk,          SYS_mmap,           SYS_munmap,       SYS_mremap,      SYS_mprotect,
                            SYS_madvise,    SYS_futex,        SYS_clock_gettime,  SYS_gettimeofday, SYS_getrandom,   SYS_getpid,
                            SYS_gettid,     SYS_rt_sigaction, SYS_rt_sigprocmask, SYS_rt_sigreturn, SYS_sigaltstack, SYS_sched_yield,
                            SYS_getrusage,  SYS_exit,         SYS_exit_group};

/// System calls that change the open file. Every descriptor that the program has is allowed to use them.
constexpr long allowed_to_writers[] = {SYS_pwrite64, SYS_ftruncate};

/// Installs a seccomp filter: first it compares the architecture, then the number of the system call with each allowed one.
void forbid_system_calls(FileAccess access) {
    if (architecture == 0) return;
    const auto load = [](std::size_t offset) { return sock_filter BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)); };
    const auto return_action = [](std::uint32_t action) { return sock_filter BPF_STMT(BPF_RET | BPF_K, action); };
    const std::uint32_t denied = SECCOMP_RET_ERRNO | EPERM;
    std::vector<sock_filter> program = {load(offsetof(seccomp_data, arch)),
                                        sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0), return_action(denied),
                                        load(offsetof(seccomp_data, nr))};
    std::vector<long> calls(std::begin(allowed), std::end(allowed));
    if (access == FileAccess::write) calls.insert(calls.end(), std::begin(allowed_to_writers), std::end(allowed_to_writers));
    for (const long call : calls) {
        program.push_back(sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1));
        program.push_back(return_action(SECCOMP_RET_ALLOW));
    }
    // tgkill is allowed if its first argument is this process.
    const auto self = static_cast<std::uint32_t>(::getpid());  // abort() signals this process; signals to others are denied
    program.insert(program.end(),
                   {sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, std::uint32_t{SYS_tgkill}, 0, 3), load(offsetof(seccomp_data, args)),
                    sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, self, 0, 1), return_action(SECCOMP_RET_ALLOW), return_action(denied)});
    const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
    (void)::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter);
}

}  // namespace

void confine(int last_descriptor, std::uint64_t memory, FileAccess access) {
    lower(RLIMIT_AS, address_space_in_use() + memory);
    lower(RLIMIT_CORE, 0);
    if (access == FileAccess::read) lower(RLIMIT_FSIZE, 0);
    (void)::prctl(PR_SET_DUMPABLE, 0);
    (void)::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    forbid_paths();
    lower(RLIMIT_NOFILE, static_cast<std::uint64_t>(last_descriptor) + 1);
    forbid_system_calls(access);
}

}  // namespace corpuscle
