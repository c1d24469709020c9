"""What our programs find in their environment, in a run, a replay and a measurement alike."""
from __future__ import annotations

import os

KEPT = 1 << 28  # bytes
MEMORY = ("glibc.malloc.hugetlb=1", f"glibc.malloc.trim_threshold={KEPT}", f"glibc.malloc.mmap_threshold={KEPT}")


def program_environment() -> dict[str, str]:
    """Threads without work sleep instead of taking a core from another process. Memory comes in large pages: the grids'
    arrays touch more small ones than a processor keeps the addresses of. What is freed stays with the process: messages
    and scratch come and go with every step, and the kernel would clear each page anew."""
    tunables = [text for text in (*MEMORY, os.environ.get("GLIBC_TUNABLES", "")) if text]
    return {"OMP_WAIT_POLICY": "passive", "GLIBC_TUNABLES": ":".join(tunables)}
