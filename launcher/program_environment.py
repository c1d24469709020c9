"""What our programs find in their environment, in a run, a replay and a measurement alike."""
from __future__ import annotations

import os


def program_environment() -> dict[str, str]:
    """Threads without work sleep instead of taking a core from another process. Memory comes in large pages: the grids'
    arrays touch more small ones than a processor keeps the addresses of."""
    tunables = [text for text in ("glibc.malloc.hugetlb=1", os.environ.get("GLIBC_TUNABLES", "")) if text]
    return {"OMP_WAIT_POLICY": "passive", "GLIBC_TUNABLES": ":".join(tunables)}
