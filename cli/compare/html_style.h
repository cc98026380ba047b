// Styles of the page: light and dark, plots included.
#pragma once

namespace pullfocus::cli {

inline constexpr char kStyle[] = R"(
:root { color-scheme: light dark; --ink: #1c1e21; --soft: #5c636b; --line: #d9dde2; --page: #ffffff; --band: #f5f6f8;
  --c0: #0067a9; --c1: #cc5200; --c2: #00835f; --c3: #b3488c; --c4: #a97900; --c5: #2e9bd6; --c6: #6a4fb3; --c7: #6b6b6b; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e6e9; --soft: #9aa2ab; --line: #363b42; --page: #16181b;
  --band: #1e2125; --c0: #5ab0ea; --c1: #ff8f4d; --c2: #3cc79c; --c3: #e58cc3; --c4: #e0b040; --c5: #8fd0f5;
  --c6: #ab95ee; --c7: #b0b0b0; } }
body { margin: 2rem auto; max-width: 76rem; padding: 0 1.2rem; background: var(--page); color: var(--ink);
  font: 15px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
h1 { font-size: 1.5rem; margin: 0 0 .2rem; } h2 { font-size: 1.2rem; margin: 2.4rem 0 .2rem; overflow-wrap: anywhere; }
h3 { font-size: 1rem; margin: 1.6rem 0 .4rem; } p { margin: .2rem 0 .8rem; } .soft { color: var(--soft); font-size: .9rem; }
.wide { overflow-x: auto; margin-bottom: .8rem; } table { border-collapse: collapse; font-size: .9rem; white-space: nowrap; }
th, td { padding: .22rem .55rem; text-align: right; font-variant-numeric: tabular-nums; border-bottom: 1px solid var(--line); }
th { font-weight: 600; color: var(--soft); vertical-align: bottom; } th:first-child, td:first-child { text-align: left; padding-left: .3rem; }
tr.group th { border-bottom: 0; padding-top: .5rem; text-align: center; } tbody tr:hover { background: var(--band); }
td.first, th.first { border-left: 1px solid var(--line); }
.plots { margin-top: 1.4rem; display: grid; grid-template-columns: repeat(auto-fit, minmax(26rem, 1fr)); gap: 1rem; }
.plot { width: 100%; height: auto; } .key { width: .9em; height: .9em; vertical-align: -.08em; margin-right: .5em; }
svg text { fill: var(--soft); font: 12px system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
svg .title { fill: var(--ink); font-size: 14px; font-weight: 600; }
svg .grid { stroke: var(--line); } svg .axis { fill: none; stroke: var(--soft); }
svg .front { fill: none; stroke: var(--soft); stroke-width: 1.2; stroke-dasharray: 5 4; } svg .l { fill: none; stroke-width: 1.6; }
.m { stroke: var(--page); stroke-width: .8; }
.m.c0 { fill: var(--c0) } .m.c1 { fill: var(--c1) } .m.c2 { fill: var(--c2) } .m.c3 { fill: var(--c3) }
.m.c4 { fill: var(--c4) } .m.c5 { fill: var(--c5) } .m.c6 { fill: var(--c6) } .m.c7 { fill: var(--c7) }
.l.c0 { stroke: var(--c0) } .l.c1 { stroke: var(--c1) } .l.c2 { stroke: var(--c2) } .l.c3 { stroke: var(--c3) }
.l.c4 { stroke: var(--c4) } .l.c5 { stroke: var(--c5) } .l.c6 { stroke: var(--c6) } .l.c7 { stroke: var(--c7) }
.pictures { display: flex; flex-wrap: wrap; gap: .8rem; margin: .3rem 0 1rem; }
figure { margin: 0; max-width: 100%; } figure img { display: block; max-width: 100%; height: auto; background: #000; }
figcaption { color: var(--soft); font-size: .82rem; } .none { box-sizing: border-box; max-width: 100%; display: flex; align-items: center; justify-content: center; border: 1px dashed var(--line); }
.scale { display: inline-block; width: 9rem; height: .7rem; vertical-align: -.05rem; margin: 0 .4rem;
  background: linear-gradient(to right, #000005, #261259, #661c80, #b3337a, #ed5e5e, #fca873, #fcfcbf); }
)";

}  // namespace pullfocus::cli
