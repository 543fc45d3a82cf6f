// Loads the program with its data, shows how far that is, and starts it as the page's address says:
//   #hanging&k_s=100                      an experiment's constants
//   ?lab=03_stiffness&step=2              a lab, at one of its steps
//   ?embed&lab=03_stiffness               in a course's page: without what was kept, with a button that opens it whole
//   ?embed&preset=flag&panels=0           likewise, the cloth alone
const canvas = document.getElementById('canvas');
const words = document.getElementById('words'), progress = document.getElementById('progress');
const embedded = new URLSearchParams(location.search).has('embed');
follow_reload();
const asked = new URLSearchParams(location.search), alone = asked.get('panels') === '0';
document.body.classList.toggle('embedded', embedded);
const program = may_share_memory() ? 'tyglab-threads' : 'tyglab';

class Refusal extends Error {}

/// Whether the server lets the page have threads (docs/web.md), and the browser has an address space for what they share.
function may_share_memory() {
  try {
    return self.crossOriginIsolated && Boolean(new WebAssembly.Memory({initial: 1, maximum: 32768, shared: true}));
  } catch {
    return false;
  }
}

function show(text) {
  words.textContent = text;
}

/// What a browser must have; a module with one vector instruction is valid where there are any.
function check_browser() {
  const simd = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15,
                               253, 98, 11]);
  if (typeof WebAssembly === 'undefined' || !WebAssembly.validate(simd))
    throw new Refusal('Tyglab needs WebAssembly with SIMD, which this browser lacks. Use a current Firefox, Chrome, Edge or ' +
                      'Safari.');
  if (!document.createElement('canvas').getContext('webgl2'))
    throw new Refusal(
        'Tyglab needs WebGL 2, which this browser lacks or has disabled. Enable hardware acceleration in its ' +
        'settings, or use a current Firefox, Chrome, Edge or Safari.');
}

let loaded = 0;

/// What comes of a file; where the network breaks off, in words.
function of_file(name, promise) {
  return promise.catch((error) => {
    throw error instanceof TypeError ? new Refusal(missing(name)) : error;
  });
}

/// A file, counted as it comes.
async function fetched(name) {
  const answer = await of_file(name, fetch(name));
  if (!answer.ok) throw new Refusal(`${name} did not load: the server answered ${answer.status} ${answer.statusText}.`);
  const counted = answer.body.pipeThrough(new TransformStream({
    transform(bytes, out) {
      loaded += bytes.length;
      progress.value = loaded / tyglab_bytes[program];
      out.enqueue(bytes);
    },
  }));
  const type = name.endsWith('.wasm') ? 'application/wasm' : 'application/octet-stream';
  return new Response(counted, {headers: {'Content-Type': type}});
}

/// The files of a pack: a count of bytes, as many bytes of JSON (names and sizes), the files.
function unpack(pack) {
  const head = new DataView(pack).getUint32(0, true);
  const index = JSON.parse(new TextDecoder().decode(new Uint8Array(pack, 4, head)));
  let at = 4 + head;
  return index.map(([name, size]) => [name, new Uint8Array(pack, (at += size) - size, size)]);
}

function write(tyglab, name, bytes) {
  tyglab.FS.mkdirTree(name.slice(0, name.lastIndexOf('/')));
  tyglab.FS.writeFile(name, bytes);
}

/// What earlier sessions kept (library.js, tyglab_keep_files).
function restore(tyglab) {
  try {
    for (const [key, text] of Object.entries(localStorage))
      if (key.startsWith('tyglab:/')) write(tyglab, key.slice('tyglab:'.length), text);
  } catch (error) {
    console.warn('Tyglab: settings cannot be stored: ' + error.message);
  }
}

/// The command line that the page's address stands for.
function arguments_of_address() {
  const words = [];
  if (location.hash.length > 1) words.push(location.href);
  else if (asked.get('preset')) words.push(asked.get('preset'));
  if (asked.get('lab')) words.push('--lab', asked.get('lab'));
  if (asked.get('lab') && asked.get('step')) words.push('--lab-step', asked.get('step'));
  if (alone) words.push('--no-panels');
  if (asked.has('report')) words.push('--session-report', '/report.json');  // docs/session-report.md, for scripts and tests
  return words;
}

/// What the program printed, without the commands of a terminal that it advises.
function without_commands(said) {
  return said.replace(/^tyglab: /, '').replace(/[;.]? `tyglab [^`]*`[^.;\n]*/g, '').trim();
}

/// The bar below an embedded canvas: the way to the whole page and, where the cloth is alone, what its panels would offer.
function show_bar(tyglab) {
  const bar = document.getElementById('bar'), whole = document.getElementById('whole');
  bar.hidden = false;
  document.getElementById('alone').hidden = !alone;
  const update = () => {
    const others = new URLSearchParams(location.search);
    for (const key of ['embed', 'panels']) others.delete(key);
    whole.href = location.pathname + (others.size ? '?' + others : '') + location.hash;
  };
  update();
  whole.addEventListener('pointerdown', update);
  whole.addEventListener('focus', update);
  const {Space, Backspace} = tyglab.tyglabPage.codes;
  for (const [id, key] of Object.entries({pause: Space, restart: Backspace}))
    document.getElementById(id).addEventListener('click', (event) => {
      for (const down of [1, 0]) tyglab._tyglab_on_key(key, down, 0);
      if (event.detail > 0) canvas.focus({preventScroll: true});  // by a pointer: keys still mean the cloth
    });
  // The canvas takes Tab: F6 goes on to the bar, and from there Tab to what follows in the course's page.
  for (const kind of ['keydown', 'keyup']) bar.addEventListener(kind, (event) => event.stopPropagation());
  canvas.addEventListener('keydown', (event) => {
    if (event.key !== 'F6') return;
    bar.querySelector(alone ? 'button' : 'a').focus();
    event.preventDefault();
  });
  canvas.ariaLabel += ' F6 leaves the cloth.';
}

/// The textures; a cloth is gray until they come, however often that takes.
async function textures() {
  for (;;)
    try {
      return unpack(await (await fetched('textures.bin')).arrayBuffer());
    } catch (error) {
      console.warn('Tyglab: ' + error.message);
      await new Promise((done) => setTimeout(done, 10000));
    }
}

/// What is not needed for the first frame.
async function load_the_rest(tyglab) {
  for (const [name, bytes] of await textures()) {
    write(tyglab, name, bytes);
    tyglab.tyglabPage.withText(name, tyglab._tyglab_on_drop);
  }
  if ('serviceWorker' in navigator && !embedded)
    navigator.serviceWorker.register('offline.js?program=' + program)
        .catch((error) => console.warn('Tyglab: the page will not work offline: ' + error.message));
}

/// How many the program may start: for its team on up to four processors (core/analysis/machine_web.cpp), for those of
/// another cloth and of copies, and for what goes on beside the frames. Who gets none does without.
function threads() {
  const processors = Math.min(navigator.hardwareConcurrency || 1, 4);
  return 8 + 4 * (processors - 1);
}

/// A text that the clipboard did not take, to be copied by hand.
function show_text(text) {
  const dialog = document.getElementById('copy'), field = document.getElementById('text');
  field.value = text;
  dialog.showModal();
  field.select();
}

/// A reload goes on with what was on the screen, which the address may not have said yet (library.js, leave).
function follow_reload() {
  try {
    const left = sessionStorage.getItem('tyglab:address');
    sessionStorage.removeItem('tyglab:address');
    if (!embedded && left && performance.getEntriesByType('navigation')[0]?.type === 'reload') history.replaceState(null, '', left);
  } catch (error) {
    console.warn('Tyglab: this tab cannot store its address: ' + error.message);
  }
}

async function start() {
  check_browser();
  const data = of_file('data.bin', fetched('data.bin').then((answer) => answer.arrayBuffer()));
  const code = new Promise((done, failed) => {
    const script = document.createElement('script');
    script.src = program + '.js';
    script.onload = done;
    script.onerror = () => failed(new Refusal(missing(program + '.js')));
    document.head.append(script);
  });
  const module = of_file(program + '.wasm', WebAssembly.compileStreaming(fetched(program + '.wasm')));
  const [compiled, packed] = await Promise.all([module, data, code]);
  show('Starting…');
  let said = '';
  const tyglab = await createTyglab({
    canvas, compiled, embedded, workerAddress: 'worker.js', threads: threads(),
    instantiateWasm: (imports, take) => {
      WebAssembly.instantiate(compiled, imports).then((instance) => take(instance, compiled));
      return {};
    },
    print: (text) => console.log(text),
    printErr: (text) => { said += text + '\n'; console.log(text); },
    showText: show_text,
    lost: () => end(
        'The browser has withdrawn graphics from this page, as happens when the driver restarts or too many pages ' +
        'draw. Try again: the address contains your constants.'),
    firstFrame: () => {
      document.getElementById('start').classList.add('gone');
      performance.mark('tyglab first frame');
      load_the_rest(tyglab).catch((error) => console.warn('Tyglab: ' + error.message));
    },
  });
  window.tyglab = tyglab;
  for (const [name, bytes] of unpack(packed)) write(tyglab, name, bytes);
  tyglab.FS.symlink('/tyglab/bin/tyglab', '/proc/self/exe');
  if (!embedded) restore(tyglab);
  else show_bar(tyglab);
  const code_of_end = tyglab.callMain(arguments_of_address());
  if (code_of_end) throw new Refusal(without_commands(said));
}

for (const kind of ['keydown', 'keyup', 'paste'])  // these are not the canvas's
  document.getElementById('copy').addEventListener(kind, (event) => event.stopPropagation());
start().catch((error) => {
  end(error instanceof Refusal ? error.message : 'Tyglab could not start: ' + error.message);
  if (!(error instanceof Refusal)) console.error(error);
});
