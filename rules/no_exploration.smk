# Where no exploration is named: the targets say what is due.


rule explore:
    input:
        name_an_exploration,


rule beside:
    input:
        name_an_exploration,
