#include "components.h"

namespace slamot::reproduce
{
namespace
{
// The verdicts' colours are those of Okabe and Ito, dark enough for white text.
const char* const kStyle = R"(
:root{--holds:#0b6e4f;--part:#8a5a00;--not:#b3401a;--none:#57606a}
@media screen and (prefers-color-scheme:dark){:root{--holds:#2ec49a;--part:#f0b840;--not:#ff8a3d;--none:#9198a1}}
.faint{color:var(--faint);font-size:.93rem}
.notice{margin:1rem 0;padding:.7rem 1rem;border-radius:.4rem;border:2px solid var(--part);font-weight:600}
.badge{display:inline-block;padding:0 .5rem;border-radius:.3rem;font-size:.85rem;font-weight:600;line-height:1.5;
white-space:nowrap;color:#fff;background:var(--none)}
@media screen and (prefers-color-scheme:dark){.badge{color:#0d1117}}
.b-holds{background:var(--holds)}.b-part{background:var(--part)}.b-not{background:var(--not)}
.counts{list-style:none;display:flex;flex-wrap:wrap;gap:.4rem 1.4rem;margin:1rem 0;padding:0}
.count{font-size:1.3rem;font-weight:600}
.verdicts{list-style:none;margin:0;padding:0}
.verdicts li{display:grid;grid-template-columns:11.5rem 1fr 8.5rem;gap:.2rem .8rem;padding:.4rem 0;border-bottom:1px solid var(--ink-grid)}
.verdicts .paper{display:block;margin-top:.8rem;font-weight:600}
.verdicts a{color:inherit;text-decoration-color:var(--ink-axis);text-underline-offset:.2em}
.claim{margin:1rem 0;padding:.1rem 1rem .3rem;border-left:.35rem solid var(--none);background:var(--shade);border-radius:0 .4rem .4rem 0}
.c-holds{border-color:var(--holds)}.c-part{border-color:var(--part)}.c-not{border-color:var(--not)}
.claim p{margin:.6rem 0}.claim .says{font-weight:600}
.claim:target{outline:2px solid var(--ink-blue)}
.checks{width:100%;margin-bottom:.5rem}
.checks td,.checks th{vertical-align:top}
.checks .words{text-align:left;white-space:normal;min-width:11rem}
.checks td:first-child{min-width:13rem}
.s-holds{color:var(--holds)}.s-part{color:var(--part)}.s-not{color:var(--not)}.s-none{color:var(--faint)}
.study td,.study th{white-space:nowrap}
.study th{white-space:normal;min-width:6.5rem}
.lead1 :is(td,th):nth-child(-n+1),.lead2 :is(td,th):nth-child(-n+2),.lead3 :is(td,th):nth-child(-n+3),
.lead4 :is(td,th):nth-child(-n+4){text-align:left;padding-left:0;white-space:normal;max-width:12rem}
.lead1 td:nth-child(1),.lead2 td:nth-child(2),.lead3 td:nth-child(3),.lead4 td:nth-child(4){min-width:12rem;max-width:20rem}
.study td{vertical-align:top}.study td .faint{font-size:.85rem}.study td.same{color:var(--ink-axis);white-space:nowrap;overflow:hidden;text-overflow:ellipsis}
.maps{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(27rem,100%),1fr));gap:0 1.2rem;align-items:start}
.maps figure{max-width:44rem}
.published td{font-style:italic;background:var(--shade)}
details{margin:1rem 0}
summary{cursor:pointer;color:var(--ink-blue)}
nav ul{margin:.2rem 0;padding-left:1.2rem}
.again{font-size:.93rem;color:var(--faint);margin:1.2rem 0 .3rem}
@media (max-width:44rem){
.verdicts li{grid-template-columns:1fr}
figure{overflow-x:auto}figure svg{min-width:38rem}.row figure svg,.maps figure svg{min-width:0}
.claim{padding-left:.7rem;padding-right:.5rem}
.checks,.checks tbody{display:block}.checks thead{display:none}
.checks tr{display:grid;grid-template-columns:auto 1fr auto;gap:.1rem .9rem;padding:.4rem 0;border-bottom:1px solid var(--ink-grid)}
.checks td{border:0;padding:0;min-width:0!important}.checks td:first-child{grid-column:1/-1}
.lead1 td:nth-child(-n+1),.lead2 td:nth-child(-n+2),.lead3 td:nth-child(-n+3),.lead4 td:nth-child(-n+4){white-space:normal;min-width:4rem}
.lead1 td:nth-child(1),.lead2 td:nth-child(2),.lead3 td:nth-child(3),.lead4 td:nth-child(4){min-width:7rem}
.study tr td{padding-right:.3rem}}
@media print{.badge{print-color-adjust:exact;-webkit-print-color-adjust:exact}.claim,.verdicts li{break-inside:avoid}
.claim{background:none}.wide{overflow:visible}table{font-size:8pt;break-inside:auto}tr{break-inside:avoid}
table .faint{font-size:7pt!important}td,th{white-space:normal!important}h2,h3,h3+p{break-after:avoid}
figure{break-inside:avoid;margin:.5rem 0}figure svg{max-height:22cm}.maps figure svg,.row figure svg{max-height:10cm}
.study td{padding:.15rem .4rem}}
)";
}  // namespace

std::string styleSheet()
{
  return kStyle;
}
}  // namespace slamot::reproduce
