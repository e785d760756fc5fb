// Takes from the calling process the right to change anything outside itself.
#pragma once

namespace cobasis {

/// From here on starting programs, creating, changing or deleting files and opening sockets fail with EPERM; open
/// descriptors stay usable. False where the system offers no such filter (seccomp).
bool enter_sandbox();

}  // namespace cobasis
