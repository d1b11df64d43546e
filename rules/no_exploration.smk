# Where no exploration is named: the target says what is due.


rule explore:
    input:
        name_an_exploration,
