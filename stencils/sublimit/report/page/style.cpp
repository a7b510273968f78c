// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/page/style.h"

namespace sublimit::page {

const char* const style = R"(
:root { color-scheme: light dark; --paper: #fcfbf8; --ink: #23262d; --quiet: #5d626d; --line: #dcd8ce; --plate: #f5f3ed;
  --link: #1f5b86; --good: #1d6a3c; --good-bg: #dfeee3; --bad: #a02c12; --bad-bg: #f8e2da; --mid: #7a5600; --mid-bg: #f7ebca;
  --s0: #3b6ea5; --s1: #c2571a; --s2: #2d7d5a; --s3: #8a4fa0; --s4: #8c6d1f; --s5: #a33b5c; --s6: #4d7c8a; --s7: #6b6b6b;
  --warm: #bf5f26; --cool: #3a76a8; --warm-soft: #f3d9c3; --cool-soft: #cfe0ee; --mix-soft: #e4e0d5; --on: #fff }
@media screen and (prefers-color-scheme: dark) { :root { --paper: #17191e; --ink: #e4e2dc; --quiet: #a3a7b0; --line: #3a3e47;
  --plate: #1f2229; --link: #8fc1e8; --good: #8fd6a8; --good-bg: #1d3a29; --bad: #f0a58d; --bad-bg: #482319; --mid: #e8c877; --mid-bg: #3f3416;
  --s0: #7fb0e0; --s1: #ee9a62; --s2: #6fc79c; --s3: #c697da; --s4: #d8b95f; --s5: #e88aa8; --s6: #8cc0cf; --s7: #b0b0b0;
  --warm: #e08a52; --cool: #6aa5d6; --warm-soft: #5a3b26; --cool-soft: #26435c; --mix-soft: #3c3a35; --on: #14161a } }
* { box-sizing: border-box }
html { -webkit-text-size-adjust: 100%; text-size-adjust: 100% }
body { margin: 0 auto; max-width: 1180px; padding: 36px 28px 96px; background: var(--paper); color: var(--ink);
  font: 16.5px/1.55 "Iowan Old Style", "Palatino Linotype", Palatino, "Source Serif 4", Georgia, "DejaVu Serif", serif; overflow-wrap: break-word }
h1, h2, h3, h4 { line-height: 1.25; font-weight: 600; break-after: avoid }
h1 { font-size: 34px; margin: 4px 0 6px; letter-spacing: -.01em }
h2 { font-size: 25px; margin: 64px 0 10px; padding-top: 18px; border-top: 2px solid var(--ink) }
h3 { font-size: 19.5px; margin: 38px 0 8px }
h4 { font-size: 16.5px; margin: 24px 0 6px }
p, ul.plain { max-width: 46em; margin: 8px 0 }
.lead { font-size: 18px; color: var(--quiet); max-width: 42em }
a { color: var(--link); text-decoration-thickness: 1px; text-underline-offset: 2px }
.quiet, .source { color: var(--quiet) }
.source { font-size: 14.5px; font-style: italic }
code, .code { font: .88em/1.4 ui-monospace, SFMono-Regular, Menlo, "DejaVu Sans Mono", monospace; overflow-wrap: anywhere }
sup, sub { line-height: 0; font-size: .72em }
.none { color: var(--quiet) }
nav.contents { margin: 20px 0; padding: 14px 18px; background: var(--plate); border-radius: 8px; font-size: 15px }
nav.contents ul { margin: 0; padding: 0; list-style: none; columns: 220px; column-gap: 28px }
nav.contents li { padding: 1px 0; break-inside: avoid }
.up { font-size: 13.5px; float: right; font-weight: 400 }
.counts { display: flex; flex-wrap: wrap; gap: 6px 14px; margin: 14px 0; padding: 0; list-style: none }
.badge { display: inline-block; white-space: nowrap; padding: 0 9px 1px; border-radius: 11px; border: 1.5px solid transparent;
  font: 600 13px/20px system-ui, "DejaVu Sans", sans-serif; color: var(--quiet) }
.proved { color: var(--good); background: var(--good-bg); border-color: var(--good) }
.disproved { color: var(--bad); background: var(--bad-bg); border-color: var(--bad) }
.evidence-for { color: var(--good); border: 1.5px dashed var(--good) }
.evidence-against { color: var(--bad); border: 1.5px dashed var(--bad) }
.borderline { color: var(--mid); background: var(--mid-bg); border: 1.5px dotted var(--mid) }
.unknown { border: 1.5px dotted var(--quiet) }
.scroll { overflow-x: auto; margin: 12px 0; max-width: 100% }
table { border-collapse: collapse; font-size: 14.5px; line-height: 1.4; font-variant-numeric: tabular-nums lining-nums }
table.wide { width: 100% }
table { min-width: min(100%, 22em) }
caption { text-align: left; color: var(--quiet); font-size: 14px; padding-bottom: 5px; caption-side: top }
th, td { padding: 6px 16px 6px 0; border-bottom: 1px solid var(--line); text-align: left; vertical-align: top; font-weight: 400 }
thead th { font-size: 13px; color: var(--quiet); border-bottom: 1.5px solid var(--ink); vertical-align: bottom; white-space: nowrap }
tbody th { font-weight: 600 }
td.wrap, .text td { min-width: 9em }
.numbers td, .numbers th { white-space: nowrap }
dl.facts { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 190px), 1fr)); gap: 8px 24px; margin: 12px 0; font-size: 15px }
dl.facts div { border-top: 1px solid var(--line); padding-top: 3px; min-width: 0 }
dt { color: var(--quiet); font-size: 13px }
dd { margin: 0; font-variant-numeric: tabular-nums lining-nums }
.figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 310px), 1fr)); gap: 22px 30px; margin: 16px 0; align-items: start }
figure { margin: 0; min-width: 0; break-inside: avoid }
figure.broad { grid-column: 1 / -1 }
figcaption { font-size: 14px; line-height: 1.45; color: var(--quiet); margin-top: 4px }
figcaption b { color: var(--ink); font-weight: 600 }
figure > svg { display: block; width: 100%; height: auto; max-width: 460px; background: var(--plate); border-radius: 8px }
figure.broad > svg { max-width: 980px }
.legend { display: flex; flex-wrap: wrap; gap: 0 14px; list-style: none; margin: 4px 0 0; padding: 0; font-size: 13px; color: var(--ink) }
.legend svg { width: 22px; height: 12px; vertical-align: -1px; margin-right: 4px }
details { margin: 8px 0; border: 1px solid var(--line); border-radius: 8px; padding: 0 14px; min-width: 0 }
details[open] { padding-bottom: 12px }
.judgements { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 430px), 1fr)); gap: 4px 30px; align-items: start; margin: 10px 0 }
details details, .judgement details, details.inner { border: 0; padding: 0; margin: 2px 0 6px; border-radius: 0; font-size: 15px }
details details[open], .judgement details[open], details.inner[open] { padding: 0 }
summary { cursor: pointer; padding: 8px 0; font-weight: 600 }
summary .quiet { font-weight: 400; margin-left: 8px; font-variant-numeric: tabular-nums lining-nums }
details details > summary, .judgement summary, details.inner > summary { padding: 2px 0; font-weight: 400; color: var(--link) }
summary:focus-visible, a:focus-visible, .scroll:focus-visible { outline: 2px solid var(--link); outline-offset: 2px }
.judgement { margin: 6px 0; padding-left: 14px; border-left: 3px solid var(--line); min-width: 0; break-inside: avoid-page }
.judgement p { margin: 3px 0 }
.frame { stroke: var(--quiet); stroke-width: 1; fill: none }
.grid { stroke: var(--line); stroke-width: .8; fill: none }
svg text { font: 11.5px system-ui, "DejaVu Sans", sans-serif; fill: var(--ink); font-variant-numeric: tabular-nums }
svg text.quiet { fill: var(--quiet) }
svg text.small { font-size: 9.5px }
svg text.on { fill: var(--on); font-weight: 600 }
.l0 { stroke: var(--s0) } .l1 { stroke: var(--s1) } .l2 { stroke: var(--s2) } .l3 { stroke: var(--s3) } .l4 { stroke: var(--s4) } .l5 { stroke: var(--s5) } .l6 { stroke: var(--s6) } .l7 { stroke: var(--s7) }
.f0 { fill: var(--s0) } .f1 { fill: var(--s1) } .f2 { fill: var(--s2) } .f3 { fill: var(--s3) } .f4 { fill: var(--s4) } .f5 { fill: var(--s5) } .f6 { fill: var(--s6) } .f7 { fill: var(--s7) }
.curve { fill: none; stroke-width: 1.8; stroke-linejoin: round; stroke-linecap: round }
.thin { stroke-width: .9 }
.faint { stroke-opacity: .45; stroke-width: 1.1 }
.rule { fill: none; stroke: var(--ink); stroke-width: 1.2; stroke-dasharray: 5 3 }
.mark { stroke-width: 1.4; stroke: var(--plate) }
.open { fill: var(--plate) }
.net { fill: none; stroke: var(--quiet); stroke-width: .7; stroke-linejoin: round }
.plus { fill: var(--cool) } .minus { fill: var(--warm) } .zero { fill: var(--plate); stroke: var(--quiet) }
.plus-soft { fill: var(--cool-soft) } .minus-soft { fill: var(--warm-soft) } .mix-soft { fill: var(--mix-soft) }
.lattice { stroke: var(--quiet); stroke-opacity: .5; stroke-width: 1; fill: none }
.area { fill: var(--cool-soft); stroke: var(--s0); stroke-width: 1.4; stroke-linejoin: round }
footer { margin-top: 70px; padding-top: 12px; border-top: 1px solid var(--line); color: var(--quiet); font-size: 14px }
@media (max-width: 560px) { body { padding: 20px 14px 60px; font-size: 16px } h1 { font-size: 27px } h2 { font-size: 22px; margin-top: 48px }
  th, td { padding-right: 11px } figure.broad > svg text { font-size: 15px } details { padding: 0 10px } }
@media print { @page { margin: 16mm 15mm } body { max-width: none; padding: 0; font-size: 10.5pt; --paper: #fff } h2 { margin-top: 0 }
  section.scheme { break-before: page } .scroll { overflow: visible } table { font-size: 8.5pt; width: 100% } tr { break-inside: avoid } thead { display: table-header-group }
  th, td { padding-right: 8px } .text td { min-width: 0 } td { overflow-wrap: anywhere } .numbers td, .numbers th, thead th { white-space: normal } .up { display: none } details { border: 0; padding: 0 } summary { list-style: none }
  a { color: inherit; text-decoration: none } figure > svg { background: none; border: .5pt solid var(--line) } svg, .badge { print-color-adjust: exact; -webkit-print-color-adjust: exact }
  .figures { grid-template-columns: repeat(auto-fill, minmax(72mm, 1fr)) } .judgements { grid-template-columns: repeat(auto-fill, minmax(80mm, 1fr)) }
  .badge { font-size: 7.5pt; line-height: 1.3; padding: 0 5px } .judgement details:not([open]), details.inner:not([open]) { display: none } }
)";

}  // namespace sublimit::page
