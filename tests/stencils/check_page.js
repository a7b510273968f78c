// SPDX-License-Identifier: Apache-2.0
// Runs inside a page, behind its script: what that makes of the report, of reports with entries that are missing, of another type,
// unknown or hostile, and of what this page is expected to say.
const original = JSON.parse(document.getElementById('report').textContent), faults = [];
const expectTrue = (condition, what) => { if (!condition) faults.push(what); };
const copy = value => JSON.parse(JSON.stringify(value));
/// The innermost first; drawings are the program's own, not the report's.
function forEachObject(value, change) {
  if (typeof value !== 'object' || value === null) return;
  for (const [key, part] of Object.entries(value)) if (key !== 'figures') forEachObject(part, change);
  if (!Array.isArray(value)) change(value);
}
/// Markup must be that of XML too: browsers repair what they read as HTML.
function expectWellFormed(markup, what) {
  const parsed = new DOMParser().parseFromString(`<div xmlns="http://www.w3.org/1999/xhtml">${markup}</div>`, 'application/xhtml+xml');
  const error = parsed.querySelector('parsererror');
  expectTrue(!error, `${what}: ${error?.textContent.slice(0, 300)}`);
  return parsed;
}
function expectUnique(ids) { expectTrue(new Set(ids).size === ids.length, 'an id twice'); return ids; }
const idsOf = parsed => [...parsed.querySelectorAll('[id]')].map(e => e.id);
const render = (report, what) => {
  try { return page(report); } catch (error) { faults.push(`${what}: ${error.stack}`); return {title: '', main: {text: ''}, contents: []}; }
};
const main = report => render(report, 'a changed report').main.text;
const count = (text, word) => text.split(word).length - 1;

// The page itself.
const said = render(original, 'the report');
expectWellFormed(said.main.text, 'the report');
const ids = expectUnique(idsOf(document));
const links = [...document.querySelectorAll('a')].map(a => a.getAttribute('href'));
expectTrue(links.length > 0, 'no links');
for (const link of links) expectTrue(link[0] === '#' && ids.includes(link.slice(1)), 'a link to nowhere: ' + link);
const images = [...document.querySelectorAll('svg[role=img]')];
expectTrue(images.length > 0, 'no figures');
for (const svg of images) expectTrue(svg.firstElementChild.tagName === 'title', 'a figure without a title');
expectTrue(document.title === said.title && document.querySelector('h1').textContent === said.title, 'the title');
for (const part of expected) expectTrue((said.title + said.main.text).includes(part), 'does not say ' + part);

const light = copy(original);
const small = {svg: '<svg xmlns="http://www.w3.org/2000/svg" role="img"><title>x</title></svg>\n', legend: [['<path/>', 'mu']]};
forEachObject(light, o => {
  for (const value of Object.values(o.figures ?? {}))
    for (const drawing of value?.svg ? [value] : Object.values(value ?? {})) if (drawing?.svg) Object.assign(drawing, small);
});

for (const s of (light.schemes ?? []).filter(s => s.neighborhoods))  // one of each kind
  s.neighborhoods = s.neighborhoods.filter((n, i, all) => all.findIndex(other => other.kind === n.kind) === i);

// Unknown keys are ignored.
const more = copy(light);
forEachObject(more, o => { o.surprise = {x: 1}; });
for (const s of more.schemes ?? []) delete s.options?.surprise;  // there, keys are data
expectTrue(main(more) === main(light), 'unknown keys change the page');

// Anything may be null or of another type.
const keys = new Set();
forEachObject(light, o => Object.keys(o).forEach(key => keys.add(key)));
for (const key of keys) {
  if (key === 'figures') continue;
  for (const other of [null, 'words', [1, null]]) {
    const changed = copy(light);
    forEachObject(changed, o => { if (key in o) o[key] = other; });
    const what = `${key} as ${JSON.stringify(other)}`;
    expectWellFormed(render(changed, what).main.text, what);
  }
}
const vertex = light.schemes?.[0]?.neighborhoods?.find(n => n.kind === 'vertex');
if (vertex) {
  const before = count(main(light), '>–</span>');
  const {lambda, mu, ratio} = vertex;
  vertex.lambda = vertex.mu = vertex.ratio = null;
  expectTrue(count(main(light), '>–</span>') === before + 4, 'not a dash for each null: three cells, and the head of the fold');
  Object.assign(vertex, {lambda, mu, ratio});
}
expectTrue(main(light).includes('All valences at once') === (light.schemes ?? []).some(s => s.all_valences), 'the verdict on all valences');
const without = copy(light);
for (const s of without.schemes ?? []) s.all_valences = null;
expectTrue(!main(without).includes('All valences at once'), 'a verdict on all valences that is none');

// Hostile names stay names.
const hostile = '</title><script>alert(1)<\/script>"\' onload=x & <b>\u0001';
for (const kind of [light.kind, '<script>', 'constructor']) {
  const changed = copy(light);
  forEachObject(changed, o => {
    for (const key of Object.keys(o)) if (typeof o[key] === 'string' && !['kind', 'verdict', 'grid'].includes(key)) o[key] = hostile;
  });
  changed.kind = kind;
  for (const s of changed.schemes ?? []) s.options = {[hostile]: hostile};
  const {main: {text}} = render(changed, 'hostile');
  const parsed = expectWellFormed(text, 'hostile');
  expectUnique(idsOf(parsed));
  expectTrue(!parsed.querySelector('script, p > title, [onload]') && !text.includes('\u0001'), 'hostile words are markup');
}

// Numbers and sentences.
for (const [shownAs, value, digits] of [['0', 0], ['−2.5', -2.5], ['0.54999', .549988], ['1.2·10<sup>−5</sup>', 1.2e-5], ['0.0001', 1e-4], ['123456', 123456],
                                        ['1.2346·10<sup>5</sup>', 123456.5], ['3.14', Math.PI, 3], ['1·10<sup>300</sup>', 1e300], ['100', 99.999, 3]])
  expectTrue(put(shown(value, digits)) === shownAs, `${value} is shown as ${put(shown(value, digits))}, not ${shownAs}`);
for (const [typeset, words] of [['C<sup>1</sup> at λ', 'C^1 at lambda'], ['μ/λ<sup>2</sup>', 'mu/lambda^2'], ['x<sup>−1</sup>'.replace('−', '-'), 'x^{-1}'],
                                ['a<sub>n</sub> of ab_n', 'a_n of ab_n'], ['blocks ±1, a &lt; b, mulberry', 'blocks +-1, a < b, mulberry'], ['^2', '^2'],
                                ['C<sup>(1,1)</sup>', 'C^{(1,1)}']])
  expectTrue(put(prose(words)) === typeset, `${words} is typeset as ${put(prose(words))}, not ${typeset}`);

const name = decodeURIComponent(location.pathname.split('/').pop());
parent.postMessage('checked ' + name + ': ' + faults.length + ' wrong' + [...new Set(faults)].slice(0, 20).map(f => '\n  ' + f).join(''), '*');
