"""claims.md: the claims as a person reads them."""

from collections.abc import Iterable, Mapping, Sequence

from foldshell.claims.design_result import describe_quantity
from foldshell.records.claims import ClaimNumbers, ClaimRecord, Correlation, Finding, PartRecord
from foldshell.records.measures import FlatSheet

HEAD = """# Claims

Each claim of Tsiamis, Oliva, Calvano (2018) judged by the numbers of this study. A difference
within its uncertainty cannot be told. Cells show the two numbers, the uncertainty of their
difference and the finding; in a name `a|b` are the first and the second design. The uncertainty
is that of numbers under the settings of the study; what other settings change stands under
Sensitivity, by names that the last section explains. docs/study.md explains the method.
"""


def write_claims(claims: Sequence[ClaimRecord], spread: str) -> str:
    """Return the page: an overview, a section a claim, and how volumes depend on settings."""
    rows = [[claim.id, claim.claim, verdict_label(claim.verdict)] for claim in claims]
    parts = [HEAD, make_table(["id", "claim", "verdict"], rows)]
    parts += [write_section(claim) for claim in claims]
    return "\n".join([*parts, spread])


def write_section(claim: ClaimRecord) -> str:
    """Return one claim: verdict, parts, numbers, uncertainty, sensitivity."""
    lines = [f"## {claim.id}: {verdict_label(claim.verdict)}", "", f"{claim.claim}.", ""]
    numbers = claim.numbers
    if numbers.findings is not None:
        lines += [write_parts(numbers.parts), *write_findings(numbers.findings)]
    else:
        lines += [write_correlations(numbers)]
    if numbers.held_by is not None:
        held = ", ".join(f"{name} {count}" for name, count in numbers.held_by.items())
        lines += [f"Limits that designs stand at, one perhaps at several: {held}.", ""]
    if numbers.flat:
        lines += [write_flat(numbers.flat)]
    largest = claim.uncertainty.largest_relative
    shown = "; ".join(f"{name_quantity(k)} {100 * value:.3g} %" for k, value in largest.items())
    method = claim.uncertainty.method
    lines += [f"Uncertainty: {method}" + (f". Largest: {shown}." if shown else "."), ""]
    if claim.sensitivity:
        lines += [f"Sensitivity: {claim.sensitivity.words}", ""]
    return "\n".join(lines + [f"{note}\n" for note in claim.notes])


def write_parts(parts: Iterable[PartRecord]) -> str:
    """Return the table of counts by part."""
    rows = [
        [
            part.part + ("" if part.asserted else " (beside the claim)"),
            *(str(count) for count in (part.holds, part.fails, part.cannot_be_told)),
            verdict_label(part.verdict),
        ]
        for part in parts
    ]
    return make_table(["part", "holds", "fails", "cannot be told", "verdict"], rows)


def write_findings(findings: Sequence[Finding]) -> list[str]:
    """Return tables with one row per design or pair and a column a part.

    Rows that have the same columns share a table: the same parts, quantities and limits.
    """
    rows: dict[frozenset, dict[str, Finding]] = {}
    for finding in findings:
        rows.setdefault(frozenset(finding.designs), {})[finding.part] = finding
    tables: dict[tuple[str, ...], list[list[str]]] = {}
    for row in rows.values():
        columns = tuple(_describe_column(finding) for finding in row.values())
        order = next(iter(row.values())).designs
        cells = [join_names(order), *(_write_cell(f, order) for f in row.values())]
        tables.setdefault(columns, []).append(cells)
    return [make_table(["design", *columns], body) for columns, body in tables.items()]


def _describe_column(finding: Finding) -> str:
    unit, factor = _unit(finding)
    limit = f", limit {format_value(finding.values[1], factor)}" if _has_limit(finding) else ""
    return f"{finding.part}: {name_quantity(finding.quantity)} [{unit}]{limit}"


def name_quantity(quantity: str) -> str:
    """Return one or two keys of measures in words."""
    return quantity.removesuffix("_rad").replace("_", " ").replace(", ", " / ")


def _has_limit(finding: Finding) -> bool:
    """Tell a number with its limit from two numbers that are compared."""
    return len(finding.designs) == 1 and ", " not in finding.quantity


def _unit(finding: Finding) -> tuple[str, float]:
    about = describe_quantity(finding.quantity.split(", ")[0])
    return (about.shown, about.factor) if about else (finding.unit, 1.0)


def _write_cell(finding: Finding, order: Sequence[str]) -> str:
    """Return both values in the order of the row's designs, the uncertainty and the verdict."""
    _, factor = _unit(finding)
    values = list(finding.values)
    if list(finding.designs) != list(order):
        values.reverse()
    shown = values[:1] if _has_limit(finding) else values
    numbers = " / ".join(format_value(value, factor) for value in shown)
    if finding.uncertainty:
        numbers += f" ± {finding.uncertainty * factor:.2g}"
    return f"{numbers}: {verdict_label(finding.verdict)}"


def join_names(names: Sequence[str]) -> str:
    """Return one name, or two of them with what they share written once: `arch-28-strip|zigzag`."""
    if len(names) == 1:
        return names[0]
    first, second = (name.split("-") for name in names)
    if len(first) != len(second):
        return " \\| ".join(names)
    return "-".join(
        a if a == b else f"{a}|{b}" for a, b in zip(first, second, strict=True)
    ).replace("|", "\\|")


def write_correlations(numbers: ClaimNumbers) -> str:
    """Return the correlations of planarity and utilization as a table."""
    rows = [["all panels", *_correlation(numbers.pooled)]] if numbers.pooled else []
    rows += [[f"{name}, all panels", *_correlation(v)] for name, v in numbers.by_surface.items()]
    rows += [[name, *_correlation(value)] for name, value in numbers.by_design.items()]
    header = ["panels of", "count", "Spearman [-]", "Pearson [-]"]
    words = ""
    if numbers.spearman_range:
        low, high = numbers.spearman_range
        words = (
            f"Within designs Spearman's correlation is {low:.2f} to {high:.2f}, median "
            f"{numbers.spearman_median:.2f}; positive in {numbers.designs_positive} of "
            f"{len(numbers.by_design)}.\n\n"
        )
    return words + make_table(header, rows)


def _correlation(value: Correlation) -> list[str]:
    return [str(value.panels), format_value(value.spearman), format_value(value.pearson)]


def write_flat(flats: Mapping[str, FlatSheet]) -> str:
    """Return what the flat sheets of equal volume are, and do."""
    header = ["folded design", "flat sheet", "sides [m]", "thickness [mm]", "volume [m3]",
              "state", "displacement, first order [m]", "utilization, panel mean [-]"]  # fmt: skip
    rows = [
        [
            name,
            flat.flat,
            " x ".join(f"{side:.4g}" for side in flat.sides_m),
            format_value(flat.thickness_m, 1e3),
            format_value(flat.volume_m3),
            flat.state,
            format_value(flat.displacement_first_order_m),
            format_value(flat.measures.utilization_panel_mean_max),
        ]
        for name, flat in flats.items()
    ]
    return make_table(header, rows)


def make_table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table in Markdown."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


def format_value(value: float | None, factor: float = 1.0) -> str:
    """Return a number with four significant digits, a dash for none."""
    return "-" if value is None else f"{value * factor:.4g}"


def verdict_label(verdict: str) -> str:
    """Return a verdict in words."""
    return verdict.replace("_", " ")
