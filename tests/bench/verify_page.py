"""The page of verify.json: one HTML file with its pictures."""
from __future__ import annotations

import base64
import html
import pathlib

STYLE = """body { font: 15px/1.45 sans-serif; max-width: 68em; margin: 2em auto; padding: 0 1em; color: #222; background: #fff }
table { border-collapse: collapse; margin: .6em 0 } td, th { padding: .15em .7em; text-align: left; border-bottom: 1px solid #ddd; vertical-align: top }
.pass { color: #17692b } .note, .warn, .cut { color: #8a5a00 } .fail { color: #b3161b; font-weight: bold }
figure { display: inline-block; margin: .4em } figcaption { font-size: 13px } details { margin: .5em 0 }
@media (prefers-color-scheme: dark) { body { color: #ddd; background: #191919 } td, th { border-color: #444 }
  .pass { color: #6cc184 } .note, .warn, .cut { color: #d9a441 } .fail { color: #ff7b7b } }"""
VERDICTS = ("pass", "note", "warn", "cut", "fail")


def text(value) -> str:
    return html.escape(str(value))


def cell(value) -> str:
    return f'<td class="{value}">{value}</td>' if value in VERDICTS else f"<td>{text(value)}</td>"


def table(head: list, rows: list[list]) -> str:
    heads = "".join(f"<th>{text(each)}</th>" for each in head)
    return f"<table><tr>{heads}</tr>" + "".join(f"<tr>{''.join(map(cell, row))}</tr>" for row in rows) + "</table>\n"


def listed(sentences: list[str], kind: str) -> str:
    return f"<ul>{''.join(f'<li class={kind}>{text(each)}</li>' for each in sentences)}</ul>\n" if sentences else ""


def picture(file: pathlib.Path, caption: str) -> str:
    if not file.is_file():
        return ""
    data = base64.b64encode(file.read_bytes()).decode()
    return f'<figure><img alt="{text(caption)}" src="data:image/png;base64,{data}"><figcaption>{text(caption)}</figcaption></figure>'


def golden_pictures(part: dict, kept: pathlib.Path, drawn: pathlib.Path) -> str:
    pairs = ""
    for row in part["figures"]:
        name = f"{row['scene']} {row['view']}"
        pairs += f"<div>{picture(kept / row['scene'] / (row['view'] + '.png'), name + ', kept')}"
        pairs += f"{picture(drawn / (row['scene'] + '-' + row['view'] + '.png'), name + ', drawn here')}</div>\n"
    return f"<details><summary>Pictures</summary>{pairs}</details>\n" if pairs else ""


def section(part: dict, kept: pathlib.Path, drawn: pathlib.Path) -> str:
    body = listed(part["problems"], "fail") + listed(part["notes"], "note") + listed(part["said"], "said")
    body += "".join(table(each["head"], each["rows"]) for each in part["tables"] if each["rows"])
    if part["part"] == "golden":
        body += golden_pictures(part, kept, drawn)
    return (f'<h2 id="{part["part"]}">{text(part["title"])}: <span class="{part["verdict"]}">{part["verdict"]}</span></h2>\n{body}')


def device_name(report: dict) -> str:
    return str(report["device"]["renderer"]).splitlines()[0]


def beside_table(report: dict, other: dict) -> str:
    """What the parts say of both devices."""
    others = {part["part"]: part for part in other["parts"]}

    def words(part: dict | None) -> str:
        return " | ".join([part["verdict"], *part["problems"], *part["notes"], *part["said"]]) if part else "not run"
    rows = [[part["title"], words(part), words(others.get(part["part"]))] for part in report["parts"]]
    return "<h2>Beside another device</h2>\n" + table(["part", device_name(report), device_name(other)], rows)


def page(report: dict, kept: pathlib.Path, drawn: pathlib.Path, beside: dict | None = None) -> str:
    """`kept`: the folder of golden pictures; `drawn`: of those that this device drew."""
    machine, device = report["machine"], report["device"]
    failed = [part["title"] for part in report["parts"] if part["verdict"] == "fail"]
    verdict = f'<p class="fail">Failed: {text(", ".join(failed))}</p>' if failed else '<p class="pass">All parts passed.</p>'
    summary = table(["part", "", "seconds", "what was found"], [
        [part["title"], part["verdict"], f"{part['seconds']:.0f}", "; ".join((part["problems"] + part["notes"] + part["said"])[:3])]
        for part in report["parts"]])
    facts = table(["", ""], [["device", device["renderer"]], ["chosen by", device["chosen"]], ["Tidemark", device["tidemark"]],
                             ["processor", f"{machine['processor']}, {machine['cores']} cores"],
                             ["system", f"{machine['system']}, Linux {machine['kernel']}, glibc {machine['glibc']}"],
                             ["started", f"{report['started']}, {report['seconds']:.0f} s in all"]])
    sections = "".join(section(part, kept, drawn) for part in report["parts"])
    compared = beside_table(report, beside) if beside else ""
    return (f"<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>Tidemark on {text(device_name(report))}</title>\n"
            f"<style>{STYLE}</style>\n<h1>Tidemark on {text(device_name(report))}</h1>\n{verdict}\n{facts}{summary}{compared}{sections}</html>\n")
