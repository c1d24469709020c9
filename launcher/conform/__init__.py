"""`polynya conform`: plays the coupler's side of docs/protocol.md against a participant and names what it does wrong.

Written from docs/protocol.md alone, without the code of core/exchange: a second reading of the protocol.
"""
