"""Hexahedral meshes from files: read (meshio), checked, renumbered and written as the one file that solvers read."""
