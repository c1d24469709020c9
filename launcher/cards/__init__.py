"""Cards of the law of Johnson & Holmquist in the formats of other codes.

One file per format (`mat_110`, `law79`), to and from one neutral form (`johnson_holmquist`), whose numbers are exact
fractions in SI."""
