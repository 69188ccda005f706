// SPDX-License-Identifier: LGPL-2.1-or-later
// The body to turn: its surface coloured by a field, lines along the fibres, edges at rest. Without this script the page shows a picture.
'use strict';
(function () {
  const body = report.data.body, place = document.getElementById('view');
  if (!body || typeof THREE === 'undefined') return;
  const canvas = document.createElement('canvas');
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
  } catch (error) {
    place.textContent = 'This browser cannot draw in three dimensions (WebGL): the picture below stays.';
    place.className = 'hint';
    return;
  }

  const bytes = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0)).buffer;
  const shorts = text => new Uint16Array(bytes(text)), integers = text => new Uint32Array(bytes(text));
  const middle = body.low.map((low, c) => (low + body.high[c]) / 2);
  const size = Math.hypot(...body.low.map((low, c) => body.high[c] - low));
  function places(text) { // in units of the size of the body, about its middle
    const numbers = shorts(text), result = new Float32Array(numbers.length);
    for (let i = 0; i < numbers.length; ++i)
      result[i] = (body.low[i % 3] + numbers[i] / 65534 * (body.high[i % 3] - body.low[i % 3]) - middle[i % 3]) / size;
    return result;
  }
  const instants = body.now.map(places), lines = body.lines.map(places);
  const values = body.fields.map(field => ({ points: field.points.map(shorts), lines: field.lines.map(shorts) }));
  const maps = {};
  for (const name in body.maps)
    maps[name] = body.maps[name].map(text => new THREE.Color(text));

  // Geometry
  const quads = integers(body.quads), triangles = new Uint32Array(quads.length / 4 * 6);
  for (let q = 0; q < quads.length / 4; ++q)
    triangles.set([quads[4 * q], quads[4 * q + 1], quads[4 * q + 2], quads[4 * q], quads[4 * q + 2], quads[4 * q + 3]], 6 * q);
  const attribute = (array, width) => new THREE.BufferAttribute(array, width);
  const coloured = THREE.VertexColors === undefined ? true : THREE.VertexColors;
  const surface = new THREE.BufferGeometry();
  surface.setIndex(attribute(triangles, 1));
  surface.setAttribute('position', attribute(instants[0].slice(), 3));
  surface.setAttribute('color', attribute(new Float32Array(instants[0].length), 3));
  const skin = new THREE.Mesh(surface, new THREE.MeshLambertMaterial({ vertexColors: coloured, side: THREE.DoubleSide, transparent: true }));
  const rest = new THREE.BufferGeometry();
  rest.setIndex(attribute(integers(body.edges), 1));
  rest.setAttribute('position', attribute(places(body.rest), 3));
  const outline = new THREE.LineSegments(rest, new THREE.LineBasicMaterial({ color: 0x888888, transparent: true, opacity: 0.35 }));
  const fibres = new THREE.BufferGeometry();
  const pairs = [];
  let begin = 0;
  for (const length of body.lengths) {
    for (let i = 1; i < length; ++i) pairs.push(begin + i - 1, begin + i);
    begin += length;
  }
  fibres.setIndex(pairs);
  fibres.setAttribute('position', attribute(new Float32Array(3 * begin), 3));
  fibres.setAttribute('color', attribute(new Float32Array(3 * begin), 3));
  const fascicles = new THREE.LineSegments(fibres, new THREE.LineBasicMaterial({ vertexColors: coloured }));
  const scene = new THREE.Scene(), camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -10, 10);
  const lamp = new THREE.DirectionalLight(0xffffff, 0.75);
  scene.add(skin, outline, fascicles, new THREE.AmbientLight(0xffffff, 0.55), lamp);

  // What is seen
  const start = { azimuth: 25, elevation: 20, zoom: 1 };
  const state = { ...start, instant: instants.length - 1, field: 0, veil: pairs.length > 0, rest: true };
  const right = new THREE.Vector3(...body.axes.right), up = new THREE.Vector3(...body.axes.up), front = right.clone().cross(up);

  // Half of the extents of the whole motion, seen from where the view starts.
  const sides = (function () {
    const a = start.azimuth * Math.PI / 180, e = start.elevation * Math.PI / 180, level = right.clone().multiplyScalar(Math.sin(a)).addScaledVector(front, Math.cos(a));
    const across = right.clone().multiplyScalar(Math.cos(a)).addScaledVector(front, -Math.sin(a));
    const towards = level.multiplyScalar(Math.cos(e)).addScaledVector(up, Math.sin(e)), upwards = towards.clone().cross(across);
    const reach = direction => body.low.reduce((sum, low, c) => sum + Math.abs(direction.getComponent(c)) * (body.high[c] - low) / 2 / size, 0);
    return [reach(across), reach(upwards)];
  })();

  function colours(numbers, field, target) {
    const map = maps[field.map], low = field.low, high = field.high;
    const most = Math.max(-low, high), from = field.map === 'diverging' ? -most : field.map === 'tissues' ? 0.5 : low;
    const to = field.map === 'diverging' ? most : field.map === 'tissues' ? body['most tissues'] + 0.5 : high;
    for (let i = 0; i < numbers.length; ++i) {
      const value = low + numbers[i] / 65534 * (high - low), part = to > from ? Math.min(1, Math.max(0, (value - from) / (to - from))) : 0.5;
      const first = Math.min(map.length - 2, Math.floor(part * (map.length - 1))), rest = part * (map.length - 1) - first;
      const a = map[first], b = map[first + 1], grey = numbers[i] === 65535;
      target[3 * i] = grey ? 0.7 : a.r + rest * (b.r - a.r);
      target[3 * i + 1] = grey ? 0.7 : a.g + rest * (b.g - a.g);
      target[3 * i + 2] = grey ? 0.7 : a.b + rest * (b.b - a.b);
    }
  }

  function update() {
    const field = body.fields[state.field];
    surface.attributes.position.array.set(instants[state.instant]);
    surface.attributes.position.needsUpdate = true;
    surface.computeVertexNormals();
    surface.computeBoundingSphere();
    fibres.attributes.position.array.set(lines[state.instant]);
    fibres.attributes.position.needsUpdate = true;
    if (field) {
      colours(values[state.field].points[state.instant], field, surface.attributes.color.array);
      colours(values[state.field].lines[state.instant], field, fibres.attributes.color.array);
      surface.attributes.color.needsUpdate = fibres.attributes.color.needsUpdate = true;
    }
    skin.material.opacity = state.veil ? 0.3 : 1;
    skin.material.depthWrite = !state.veil;
    fascicles.visible = state.veil;
    outline.visible = state.rest;
    tell();
    draw();
  }

  function draw() {
    const width = canvas.clientWidth || 600, height = canvas.clientHeight || 400, degree = Math.PI / 180;
    renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    renderer.setSize(width, height, false);
    const aspect = width / height, half = 1.12 * Math.max(sides[1], sides[0] / aspect) / state.zoom;
    camera.left = -half * aspect;
    camera.right = half * aspect;
    camera.top = half;
    camera.bottom = -half;
    const a = state.azimuth * degree, e = state.elevation * degree;
    const level = right.clone().multiplyScalar(Math.sin(a)).addScaledVector(front, Math.cos(a));
    camera.position.copy(level.multiplyScalar(Math.cos(e)).addScaledVector(up, Math.sin(e)));
    camera.up.copy(up);
    camera.lookAt(0, 0, 0);
    camera.updateProjectionMatrix();
    lamp.position.copy(camera.position).addScaledVector(up, 0.5);
    renderer.render(scene, camera);
  }

  // Controls
  const element = (name, properties) => Object.assign(document.createElement(name), properties);
  const labelled = (text, control) => { const label = element('label', { textContent: text + ' ' }); label.append(control); return label; };
  const unit = field => field.unit ? ' [' + field.unit + ']' : '';
  const digits = value => Number(value.toPrecision(4)).toString();
  const choice = element('select', { id: 'field' });
  body.fields.forEach((field, i) => choice.append(element('option', { value: i, textContent: field.name + unit(field) })));
  const slider = element('input', { type: 'range', min: 0, max: instants.length - 1, step: 1, value: state.instant, id: 'instant' });
  const clock = element('output', { id: 'clock' });
  const veil = element('input', { type: 'checkbox', checked: state.veil }), shape = element('input', { type: 'checkbox', checked: true });
  const key = element('div', { className: 'key' }), ramp = element('span', { className: 'ramp' });
  const lowest = element('span', {}), highest = element('span', {}), pointed = element('output', { id: 'pointed', className: 'hint' });
  function swatch(tissue) {
    const box = element('span', { className: 'swatch' });
    box.style.background = tissue.colour;
    const part = element('span', {});
    part.append(box, ' ' + tissue.name + ' ');
    return part;
  }
  const controls = element('div', { className: 'controls' });
  let playing = 0;
  const play = report.button('Play', () => {
    if (playing) { clearInterval(playing); playing = 0; play.textContent = 'Play'; return; }
    play.textContent = 'Stop';
    playing = setInterval(() => show((state.instant + 1) % instants.length), 150);
  });
  if (body.fields.length > 0) controls.append(labelled('Colour', choice));
  if (instants.length > 1) controls.append(play, labelled('Time', slider));
  controls.append(clock);
  if (pairs.length > 0) controls.append(labelled('Fibres', veil));
  controls.append(labelled('At rest', shape), report.button('Reset view', () => { Object.assign(state, start); draw(); }));
  canvas.className = 'scene';
  canvas.tabIndex = 0;
  canvas.setAttribute('role', 'application');
  canvas.setAttribute('aria-label', 'The body in three dimensions. Arrow keys turn it, plus and minus zoom, Page Up and Page Down change the time, Home resets the view.');
  place.append(controls, canvas, key, pointed, element('p', { className: 'hint', textContent: 'Drag or arrow keys turn; wheel or + and - zoom; Page Up and Page Down change the time; point at the body for a value.' }));

  function tell() {
    const field = body.fields[state.field];
    clock.textContent = 't = ' + digits(body.times[state.instant]) + ' s';
    slider.value = state.instant;
    if (!field) return;
    const most = Math.max(-field.low, field.high), diverging = field.map === 'diverging';
    lowest.textContent = digits(diverging ? -most : field.low);
    highest.textContent = digits(diverging ? most : field.high) + ' ' + (field.unit || '');
    ramp.style.background = 'linear-gradient(to right, ' + body.maps[field.map].join(',') + ')';
    if (field.map === 'tissues') key.replaceChildren(...body.tissues.map(swatch)); else key.replaceChildren(lowest, ramp, highest);
  }
  function show(instant) { state.instant = instant; update(); }
  choice.addEventListener('change', () => { state.field = Number(choice.value); update(); });
  slider.addEventListener('input', () => show(Number(slider.value)));
  veil.addEventListener('change', () => { state.veil = veil.checked; update(); });
  shape.addEventListener('change', () => { state.rest = shape.checked; update(); });

  function turn(azimuth, elevation) {
    state.azimuth += azimuth;
    state.elevation = Math.min(89, Math.max(-89, state.elevation + elevation));
    draw();
  }
  function zoom(factor) { state.zoom = Math.min(20, Math.max(0.3, state.zoom * factor)); draw(); }
  let held = null;
  canvas.addEventListener('pointerdown', event => { held = [event.clientX, event.clientY]; canvas.setPointerCapture(event.pointerId); });
  canvas.addEventListener('pointerup', () => { held = null; });
  canvas.addEventListener('pointermove', event => {
    if (held) {
      turn((held[0] - event.clientX) * 0.5, (event.clientY - held[1]) * 0.5);
      held = [event.clientX, event.clientY];
    } else point(event);
  });
  canvas.addEventListener('wheel', event => { event.preventDefault(); zoom(event.deltaY < 0 ? 1.1 : 1 / 1.1); }, { passive: false });
  canvas.addEventListener('keydown', event => {
    const moves = { ArrowLeft: () => turn(-10, 0), ArrowRight: () => turn(10, 0), ArrowUp: () => turn(0, 10), ArrowDown: () => turn(0, -10),
      '+': () => zoom(1.2), '=': () => zoom(1.2), '-': () => zoom(1 / 1.2), Home: () => { Object.assign(state, start); draw(); },
      PageDown: () => show(Math.min(instants.length - 1, state.instant + 1)), PageUp: () => show(Math.max(0, state.instant - 1)) };
    if (moves[event.key]) { event.preventDefault(); moves[event.key](); }
  });

  const ray = new THREE.Raycaster();
  function point(event) {
    const box = canvas.getBoundingClientRect(), field = body.fields[state.field];
    ray.setFromCamera({ x: (event.clientX - box.left) / box.width * 2 - 1, y: 1 - (event.clientY - box.top) / box.height * 2 }, camera);
    const hit = ray.intersectObject(skin)[0];
    if (!hit || !field) { pointed.textContent = ''; return; }
    const position = surface.attributes.position, corners = [hit.face.a, hit.face.b, hit.face.c];
    const distance = corner => hit.point.distanceToSquared(new THREE.Vector3().fromBufferAttribute(position, corner));
    const nearest = corners.reduce((a, b) => distance(a) <= distance(b) ? a : b), number = values[state.field].points[state.instant][nearest];
    const value = field.low + number / 65534 * (field.high - field.low);
    const tissue = field.map === 'tissues' && body.tissues.find(one => one.number === Math.round(value));
    pointed.textContent = number === 65535 ? field.name + ' is not defined here' : field.name + ' = ' + (tissue ? tissue.name : digits(value) + ' ' + (field.unit || ''));
  }

  new ResizeObserver(draw).observe(canvas);
  report.view = { state, update, draw, canvas };
  const picture = document.querySelector('#body > img'), details = element('details', {});
  details.append(element('summary', { textContent: 'The same as a picture' }));
  picture.before(details);
  details.append(picture);
  update();
})();
