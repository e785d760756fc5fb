#include "mesh/sandbox.hpp"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <cerrno>
#include <cstddef>
#include <vector>

namespace cobasis {
namespace {

#if defined(__x86_64__)
constexpr unsigned architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr unsigned architecture = AUDIT_ARCH_AARCH64;
#else
constexpr unsigned architecture = 0;
#endif

constexpr unsigned argument(unsigned i) { return unsigned{offsetof(seccomp_data, args)} + 8 * i; }

// System calls that start programs or touch the outside, whatever their arguments.
constexpr int refused[] = {
    SYS_execve,    SYS_execveat,       SYS_socket,   SYS_connect,   SYS_kill,    SYS_tkill,   SYS_ptrace,
    SYS_truncate,  SYS_unlinkat,       SYS_renameat, SYS_renameat2, SYS_mkdirat, SYS_mknodat, SYS_linkat,
    SYS_symlinkat, SYS_fchmodat,       SYS_fchownat, SYS_utimensat, SYS_mount,   SYS_umount2, SYS_setxattr,
    SYS_openat2,   SYS_io_uring_setup,
#if defined(__x86_64__)
    SYS_unlink,    SYS_rename,         SYS_mkdir,    SYS_rmdir,     SYS_mknod,   SYS_link,    SYS_symlink,
    SYS_chmod,     SYS_chown,          SYS_lchown,   SYS_utime,     SYS_utimes,  SYS_creat,   SYS_vfork,
#endif
};

void refuse_writing_open(std::vector<sock_filter>& program, int call, int flags_argument) {
  program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(call), 0, 4));
  program.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, argument(flags_argument)));
  program.push_back(BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, O_WRONLY | O_RDWR | O_CREAT | O_TRUNC, 0, 1));
  program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM));
  program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
}

}  // namespace

bool enter_sandbox() {
  if (architecture == 0) return false;
  std::vector<sock_filter> program {
    BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0), BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
#if defined(__x86_64__)
        BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x40000000u, 0, 1),  // the x32 twins of all calls
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM),
#endif
  };
  for (const int call : refused) {
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(call), 0, 1));
    program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM));
  }
#if defined(__x86_64__)
  refuse_writing_open(program, SYS_open, 1);
#endif
  refuse_writing_open(program, SYS_openat, 2);
  program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

}  // namespace cobasis
