"""The tables as pages of Markdown and as one HTML page, from the cells of any number of sources."""
import html

import baselines
import cells

PREDICTS = "simulated-thesis"  # sources of this name show by how much they miss the thesis
NEAR = 0.05
PAGES = {**{f"table-{table}": f"Table {table}: {title}" for table, title in cells.TITLES.items()},
         "comparisons": "Positions, patches, mappings, blocks", "parameters": "Parameters of the runs and simulations"}
STYLE = """body{font:15px/1.45 system-ui,sans-serif;max-width:70rem;margin:2rem auto;padding:0 1rem;color:#222}
table{border-collapse:collapse;margin:.6rem 0 1.6rem}td,th{padding:.15rem .6rem}
td,th{text-align:right;border-bottom:1px solid #ddd}
.name{text-align:left}tr.first td{border-top:2px solid #999}small{color:#777}
figure{margin:1rem 0}svg{max-width:100%;height:auto}"""


def number(value):
    """Three digits or all before the point; words as they are."""
    if value is None:
        return ""
    if isinstance(value, (str, int)):
        return str(value)
    return f"{value:.0f}" if abs(value) >= 100 else f"{value:.1f}" if abs(value) >= 10 else \
        f"{value:.2f}" if abs(value) >= 0.1 else f"{value:.3f}"


def cell_text(table, source, row, kind, nodes):
    ms = table.ms(source, row, kind, nodes)
    missed = table.deviations(source, kind).get((row, nodes)) if source.startswith(PREDICTS) else None
    return number(ms) + (f" ({100 * missed:+.0f} %)" if missed is not None else "")


def sheet_of(table, kind):
    """A table of the thesis with a line for each row and source."""
    nodes = table.nodes(kind)
    rows = []
    for row in table.rows(kind):
        sources = [source for source in table.sources if table.best_nodes(source, row, kind)]
        for place, source in enumerate(sources):
            rows.append([row if place == 0 else "", source] + [cell_text(table, source, row, kind, n) for n in nodes] +
                        [table.best_nodes(source, row, kind)])
    return {"title": f"Table {table.table}: {cells.TITLES[table.table]}; {kind}s, ms a frame",
            "note": summary(table, kind), "picture": f"table-{table.table}-{kind}s", "page": f"table-{table.table}",
            "header": [cells.ROWS[table.table], "source"] + [f"P = {n}" for n in nodes] + ["best P"], "rows": rows}


def summary(table, kind):
    """One sentence for each source beside the thesis."""
    sentences = []
    for source in table.sources:
        deviations = table.deviations(source, kind)
        if source == "thesis" or not deviations:
            continue
        if source.startswith(PREDICTS):
            (row, nodes), worst = max(deviations.items(), key=lambda item: abs(item[1]))
            regrets = table.regrets(source, kind).values()
            near = sum(regret <= NEAR for regret in regrets)
            sentences.append(f"\"{source}\" differs from the thesis by {100 * table.median_error(source, kind):.0f} % in "
                             f"the median, and by at most {100 * worst:+.0f} % (row {row}, P = {nodes}). In {near} of "
                             f"{len(regrets)} rows, its best P took at most {100 * NEAR:.0f} % more than the least time "
                             f"in the thesis.")
        else:
            factors = sorted(1 / (1 + deviation) for deviation in deviations.values())
            sentences.append(f"\"{source}\" is {number(factors[0])} to {number(factors[-1])} times as fast as the thesis.")
    return " ".join(sentences)


def sheets_of_kind(table, kind):
    """A table of the thesis and, where a source predicts it, how well."""
    predicting = [source for source in table.sources if source.startswith(PREDICTS) and table.deviations(source, kind)]
    return [sheet_of(table, kind)] + ([baselines.sheet_of(table, kind, predicting)] if predicting else [])


def sheets_of(parts):
    """All tables that any source but the thesis has."""
    tables = cells.beside_thesis(parts)
    sheets = [sheet for table in tables for kind in cells.KINDS[table]
              for sheet in sheets_of_kind(cells.Cells(table, parts), kind)]
    if "4.3" in tables:
        sheets.append({"title": "Figure 4.12: nodes, polygons and milliseconds", "note": "Table 4.3, drawn.",
                       "picture": "figure-4.12", "page": "table-4.3", "header": [], "rows": []})
    return sheets


def parameters_of(parts):
    """What simulations were fitted with, once for each source."""
    rows = {(part["source"], name): value for part in parts for name, value in part.get("parameters", {}).items()}
    return [{"title": "Parameters", "note": "", "page": "parameters", "header": ["source", "parameter", "value"],
             "rows": [[source, name, value if isinstance(value, (int, float)) else str(value)]
                      for (source, name), value in rows.items()]}] if rows else []


def is_text(sheet, column):
    """Whether a column has words, which stand at the left."""
    values = [row[column] for row in sheet["rows"] if row[column] not in ("", None)]
    return bool(values) and isinstance(values[0], str) and not values[0][0].isdigit()


def markdown(title, sheets, pictures):
    """One page. `pictures`: by name."""
    text = f"# {title}\n\n[All tables](tables.md) explains the sources.\n\n"
    for sheet in sheets:
        text += f"## {sheet['title']}\n\n" + (sheet["note"] + "\n\n" if sheet["note"] else "")
        if sheet.get("picture") in pictures:
            text += f"![{sheet['title']}]({sheet['picture']}.svg)\n\n"
        if sheet["rows"]:
            sides = [":--" if is_text(sheet, column) else "--:" for column in range(len(sheet["header"]))]
            lines = [[number(value) for value in row] for row in [sheet["header"], sides, *sheet["rows"]]]
            text += "".join("| " + " | ".join(line) + " |\n" for line in lines) + "\n"
    return text.rstrip() + "\n"


def markdown_pages(intro, sheets, pictures):
    """The text of each file: a page for each table and topic, and tables.md, which leads to them."""
    shown = {}
    for sheet in sheets:
        shown.setdefault(sheet.get("page", "comparisons"), []).append(sheet)
    files, links = {}, []
    for name, title in PAGES.items():
        if name in shown:
            files[f"{name}.md"] = markdown(title.split(":")[0], shown[name], pictures)
            links.append(f"- [{title}]({name}.md)\n")
    return {"tables.md": f"# The tables of 1992, all cells\n\n{intro}\n\n{''.join(links)}", **files}


def html_table(sheet):
    sides = [" class=\"name\"" if is_text(sheet, column) else "" for column in range(len(sheet["header"]))]

    def row_text(row, tag):
        first = ' class="first"' if tag == "td" and row[0] != "" else ""
        fields = [f"<{tag}{side}>{html.escape(number(value))}</{tag}>" for side, value in zip(sides, row)]
        return f"<tr{first}>{''.join(fields)}</tr>\n"
    rows = row_text(sheet["header"], "th") + "".join(row_text(row, "td") for row in sheet["rows"])
    return f"<table>\n{rows}</table>\n"


def page(intro, sheets, pictures):
    """One HTML file with everything. `pictures`: the SVG of each name."""
    text = ""
    for sheet in sheets:
        text += f"<h2>{html.escape(sheet['title'])}</h2>\n"
        text += f"<p>{html.escape(sheet['note'])}</p>\n" if sheet["note"] else ""
        if sheet.get("picture") in pictures:
            text += f"<figure>{pictures[sheet['picture']]}</figure>\n"
        text += html_table(sheet) if sheet["rows"] else ""
    return ("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>1992's tables</title>\n"
            f"<style>{STYLE}</style></head>\n<body>\n<h1>1992's tables</h1>\n<p>{html.escape(intro)}</p>\n{text}"
            "</body></html>\n")
