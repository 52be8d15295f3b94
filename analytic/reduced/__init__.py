"""The paper, Secs. 3 to 5: one degree of freedom, Eq. 41, for every model of the tip."""
