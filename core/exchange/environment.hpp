#pragma once

namespace polynya::exchange {

/// Asks the kernel to kill this process when the thread that started it ends (PR_SET_PDEATHSIG, SIGKILL), so that no
/// solver outlives its launcher. Call it first in main().
void die_with_parent();

/// True while a process of this host exists and is not a zombie.
bool process_is_alive(long pid);

}  // namespace polynya::exchange
