// SPDX-License-Identifier: LGPL-2.1-or-later
// Diagrams that tell their values, and tables to copy. Without this script the page shows drawings.
'use strict';
const report = { data: JSON.parse(document.getElementById('data').textContent), charts: [] };

report.colour = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

report.marks = ['#2b6cff', '#ff3b30'];
report.digits = function (value) {
  const size = Math.abs(value), short = Number(value.toPrecision(4));
  return size > 0 && (size < 1e-3 || size >= 1e6) ? short.toExponential() : short.toString();
};

report.copy = function (text, button) {
  const done = () => { const before = button.textContent; button.textContent = 'Copied'; setTimeout(() => { button.textContent = before; }, 1500); };
  const area = document.createElement('textarea'); // pages from files may not use the clipboard directly
  area.value = text;
  document.body.append(area);
  area.select();
  if (document.execCommand('copy')) done();
  area.remove();
};

report.button = function (text, action) {
  const button = document.createElement('button');
  button.type = 'button';
  button.textContent = text;
  button.addEventListener('click', () => action(button));
  return button;
};

(function () {
  const palette = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', null];
  const marks = ['circle', 'rect', 'triangle', 'rectRot', 'star', 'crossRot'];

  for (const table of document.querySelectorAll('.table')) {
    const text = () => [...table.querySelectorAll('tr')].map(row => [...row.cells].map(cell => cell.textContent).join('\t')).join('\n');
    table.before(report.button('Copy table', button => report.copy(text(), button)));
  }

  function axis(title, logarithmic, words) {
    const options = { type: logarithmic ? 'logarithmic' : 'linear', title: { display: title !== '', text: title }, ticks: {}, grid: { color: report.colour('--line') } };
    if (words.length > 0) {
      options.afterBuildTicks = scale => { scale.ticks = words.map(word => ({ value: word[0] })); };
      options.ticks.callback = value => { const found = words.find(word => word[0] === value); return found ? found[1] : ''; };
      options.ticks.autoSkip = false;
      if (!logarithmic) { options.offset = true; }
    } else {
      options.ticks.callback = function (value, index, ticks) { // 3.13e-6 instead of 0.000003130
        const leading = value / 10 ** Math.floor(Math.log10(Math.abs(value)));
        if (logarithmic && ticks.length > 8 && ![1, 2, 5].includes(Math.round(leading * 1e6) / 1e6)) return '';
        return report.digits(value);
      };
    }
    return options;
  }

  // What a point tells: where it is, and its curve with its value, both with five digits or in the words of the axis.
  function told(chart) {
    const text = (value, words) => (words.find(word => word[0] === value) || [0, Number(value.toPrecision(5)).toString()])[1];
    return {
      title: items => items.length > 0 ? (chart.x || 'x') + ' = ' + text(items[0].parsed.x, chart.xWords) : '',
      label: item => item.dataset.label + ': ' + text(item.parsed.y, chart.yWords)
    };
  }

  function settings(chart) {
    const datasets = chart.curves.map((curve, i) => {
      const colour = palette[i % palette.length] || report.colour('--ink');
      return {
        label: curve.title, data: curve.points.map(point => ({ x: point[0], y: point[1] })), showLine: chart.lines,
        borderColor: colour, backgroundColor: colour, borderWidth: 2, borderDash: chart.marks ? [] : [[], [7, 3], [2, 3], [9, 3, 2, 3]][Math.floor(i / palette.length) % 4],
        pointRadius: chart.marks ? (chart.lines ? 3.5 : 7) : 0, pointHitRadius: 8, pointStyle: marks[i % marks.length], tension: 0
      };
    });
    return {
      type: 'scatter', data: { datasets },
      options: {
        animation: false, maintainAspectRatio: false, normalized: true,
        interaction: { mode: 'nearest', intersect: false },
        scales: { x: axis(chart.x, chart.logX, chart.xWords), y: axis(chart.y, chart.logY, chart.yWords) },
        plugins: { tooltip: { callbacks: told(chart) }, legend: { position: 'bottom', labels: { usePointStyle: true, boxHeight: 6 } } }
      }
    };
  }

  function build(figure) {
    const holder = document.createElement('div');
    holder.className = 'charts';
    for (const number of figure.dataset.charts.split(' ')) {
      const chart = report.data.charts[number], plot = document.createElement('div'), part = document.createElement('div'), canvas = document.createElement('canvas');
      plot.className = 'plot';
      canvas.setAttribute('role', 'img');
      canvas.setAttribute('aria-label', chart.title + ': ' + chart.curves.map(curve => curve.title).join(', '));
      plot.append(canvas);
      const rows = () => chart.curves.flatMap(curve => curve.points.map(point => [curve.title, point[0], point[1]].join('\t'))).join('\n');
      part.append(plot, report.button('Copy values', button => report.copy(['curve', chart.x, chart.y].join('\t') + '\n' + rows(), button)));
      holder.append(part);
      report.charts[number] = new Chart(canvas, settings(chart));
    }
    figure.querySelector('img').replaceWith(holder);
  }

  function colours() {
    Chart.defaults.color = report.colour('--ink');
    Chart.defaults.borderColor = report.colour('--line');
  }

  if (typeof Chart !== 'undefined') {
    colours();
    const seen = new IntersectionObserver(entries => {
      for (const entry of entries)
        if (entry.isIntersecting) { seen.unobserve(entry.target); build(entry.target); }
    }, { rootMargin: '400px' });
    for (const figure of document.querySelectorAll('figure.chart')) seen.observe(figure);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
      colours();
      report.charts.forEach((chart, i) => { const fresh = settings(report.data.charts[i]); chart.data = fresh.data; chart.options = fresh.options; chart.update(); });
    });
  }
})();
