// program.js PAGE FOLDER ARGUMENT…: runs the page's program under Node with these arguments, as `tyglab ARGUMENT…`. Its
// working folder begins empty, and what it wrote there is in FOLDER afterwards. TYGLAB_PROGRAM names the program, which is
// tyglab without it.
'use strict';
const fs = require('fs'), path = require('path');
const [page, folder, ...words] = process.argv.slice(2);

// The files of a pack (cmake/web/pack).
function unpack(file) {
  const pack = fs.readFileSync(file), head = pack.readUInt32LE(0);
  let at = 4 + head;
  return JSON.parse(pack.toString('utf8', 4, at)).map(([name, size]) => [name, pack.subarray(at, at += size)]);
}

const program = process.env.TYGLAB_PROGRAM ?? 'tyglab';
require(path.resolve(page, program + '.js'))({
  wasmBinary: fs.readFileSync(path.join(page, program + '.wasm')),
  threads: 12,
  print: (text) => process.stdout.write(text + '\n'),
  printErr: (text) => process.stderr.write(text + '\n'),
}).then((tyglab) => {
  for (const [name, bytes] of [...unpack(path.join(page, 'data.bin')), ...unpack(path.join(page, 'textures.bin'))]) {
    tyglab.FS.mkdirTree(path.posix.dirname(name));
    tyglab.FS.writeFile(name, bytes);
  }
  tyglab.FS.symlink('/tyglab/bin/tyglab', '/proc/self/exe');
  tyglab.FS.mkdirTree('/work');
  tyglab.FS.chdir('/work');
  const code = tyglab.callMain(words);
  for (const name of tyglab.FS.readdir('/work'))
    if (name !== '.' && name !== '..') fs.writeFileSync(path.join(folder, name), tyglab.FS.readFile('/work/' + name));
  process.exit(code);
});
