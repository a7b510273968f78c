// SPDX-License-Identifier: Apache-2.0
// Runs inside a page with everything unfolded: what is wider than the page, cut off, or on top of something else.
document.querySelectorAll('details').forEach(d => { d.open = true; });
const wrong = [];
const name = e => e.tagName + '.' + (e.getAttribute('class') || '') + ' "' + e.textContent.trim().slice(0, 30) + '"';
const root = document.documentElement, width = root.clientWidth;
if (root.scrollWidth > width) wrong.push('the page is ' + root.scrollWidth + ' wide in ' + width);
const meet = (b, c, x, y) =>
  Math.min(b.right, c.right) - Math.max(b.left, c.left) > x && Math.min(b.bottom, c.bottom) - Math.max(b.top, c.top) > y;

document.querySelectorAll('main *, header *, nav *').forEach(e => {
  if ((e.closest('svg') && e.tagName !== 'svg') || (e.closest('.scroll') && !e.matches('.scroll'))) return;
  const b = e.getBoundingClientRect();
  if (b.width > 0 && (b.left < -1 || b.right > width + 1)) wrong.push('outside the page: ' + name(e));
});
document.querySelectorAll('svg').forEach(s => {
  const frame = s.getBoundingClientRect();
  const texts = [...s.querySelectorAll('text')].map(t => [t, t.getBoundingClientRect()]);
  texts.forEach(([t, b], i) => {
    if (b.left < frame.left - 1 || b.right > frame.right + 1 || b.top < frame.top - 1 || b.bottom > frame.bottom + 1)
      wrong.push('cut off: ' + name(t) + ' in ' + name(s));
    texts.slice(0, i).forEach(([u, c]) => {
      if (meet(b, c, 1, 3)) wrong.push('on top of each other: ' + name(t) + ' and ' + name(u) + ' in ' + name(s));
    });
  });
});
['figure', 'section > *', 'details > *', '.judgement', 'dl.facts > div', 'li'].forEach(q => {
  const all = [...document.querySelectorAll(q)].filter(e => e.getBoundingClientRect().width > 0);
  all.slice(1).forEach((f, i) => {
    const e = all[i];
    if (e.parentNode === f.parentNode && meet(e.getBoundingClientRect(), f.getBoundingClientRect(), 1, 1))
      wrong.push('on top of each other: ' + name(e) + ' and ' + name(f));
  });
});
const where = decodeURIComponent(location.pathname.split('/').pop());
parent.postMessage('measured ' + where + ': ' + wrong.length + ' wrong at ' + innerWidth +
                   [...new Set(wrong)].slice(0, 20).map(w => '\n  ' + w).join(''), '*');
