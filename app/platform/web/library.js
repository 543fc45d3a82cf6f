// What the C++ of app/platform/web asks of the page, and the page's events for it.
addToLibrary({
  $tyglabPage__deps: ['emscripten_resize_heap', '$FS', '$stringToNewUTF8', 'free', 'malloc'],
  $tyglabPage__postset: "Module['tyglabPage'] = tyglabPage;",
  $tyglabPage: {
    // GLFW's numbers of keys that type no letter or digit, by KeyboardEvent.code.
    codes: {
      Space: 32, Quote: 39, Comma: 44, Minus: 45, Period: 46, Slash: 47, Semicolon: 59, Equal: 61, BracketLeft: 91,
      Backslash: 92, BracketRight: 93, Backquote: 96, Escape: 256, Enter: 257, Tab: 258, Backspace: 259, Insert: 260,
      Delete: 261, ArrowRight: 262, ArrowLeft: 263, ArrowDown: 264, ArrowUp: 265, PageUp: 266, PageDown: 267, Home: 268,
      End: 269, CapsLock: 280, F1: 290, F2: 291, F3: 292, F4: 293, F7: 296, F8: 297, F9: 298, F10: 299,
      NumpadDecimal: 330, NumpadDivide: 331, NumpadMultiply: 332, NumpadSubtract: 333, NumpadAdd: 334, NumpadEnter: 335,
      ShiftLeft: 340, ControlLeft: 341, AltLeft: 342, MetaLeft: 341, ShiftRight: 344, ControlRight: 345, AltRight: 346,
      MetaRight: 345,
    },
    // With Ctrl, and with Ctrl and Shift, these belong to the browser, whatever a page does or ought to do.
    kept: ['twnqr', 'twnqrijc'],
    buttons: [0, 2, 1, 3, 4],
    cursor: '',
    took: true,  // the clipboard, what it was given last
    visited: false,  // the browser came to the address, by back, forward or a link, and the program follows
    workers: {},
    // Copies that have not begun, and the memory that they are given: in pieces, which come back. New memory costs a frame
    // many times what copying into used one does, so pieces are made between frames, in a few milliseconds each time.
    waiting: [],
    pieces: [],
    pieceSize: 1 << 20,
    piecesMissing: () => tyglabPage.pieces.length * tyglabPage.pieceSize < _tyglab_memory_end(),
    beginWaiting: () => {
      const begun = performance.now();
      while (tyglabPage.waiting.length > 0) {
        while (tyglabPage.piecesMissing()) {
          if (performance.now() > begun + 4 && !document.hidden) return void setTimeout(tyglabPage.beginWaiting);
          tyglabPage.pieces.push(new Uint8Array(tyglabPage.pieceSize).fill(1));
        }
        tyglabPage.beginCopy(tyglabPage.waiting.shift());
      }
    },
    beginCopy: ({number, parts}) => {
      const report = (bytes) => {
        const at = _malloc(bytes.length);
        HEAPU8.set(bytes, at);
        _tyglab_on_report(number, at, bytes.length);
        _free(at);
      };
      const fail = (message) => {
        console.error('Tyglab: a worker failed: ' + message);
        report(new TextEncoder().encode('eThe browser could not begin or finish this: ' + message));
      };
      try {
        const worker = tyglabPage.workers[number] = new Worker(Module.workerAddress);
        worker.onmessage = ({data}) => (data.pieces ? tyglabPage.takeBack(data.pieces) : report(data));
        worker.onerror = (event) => fail(event.message ?? Module.workerAddress + ' did not load.');
        const pieces = tyglabPage.memoryInPieces();
        worker.postMessage({module: Module.compiled, pieces, parts}, pieces.map((piece) => piece.buffer));
      } catch (error) {
        fail(error.message);
      }
    },
    memoryInPieces: () => {
      const taken = [], end = _tyglab_memory_end();
      for (let at = 0; at < end; at += tyglabPage.pieceSize) {
        const piece = tyglabPage.pieces.pop(), part = HEAPU8.subarray(at, Math.min(at + piece.length, end));
        piece.set(part);
        taken.push(piece.subarray(0, part.length));  // what follows must stay 0 in the copy
      }
      return taken;
    },
    takeBack: (pieces) => {
      for (const piece of pieces) if (tyglabPage.piecesMissing()) tyglabPage.pieces.push(new Uint8Array(piece.buffer));
    },
    // In a worker: the memory of the page becomes this instance's, and the work is done.
    becomeCopy: (pieces, parts) => {
      const bytes = pieces.reduce((sum, piece) => sum + piece.length, 0);
      if (bytes > HEAPU8.length) _emscripten_resize_heap(bytes);
      let at = 0;
      for (const piece of pieces) {
        HEAPU8.set(piece, at);
        at += piece.length;
      }
      postMessage({pieces}, pieces.map((piece) => piece.buffer));
      _tyglab_run_copy(parts);
    },
    field: null,
    typed: [],
    // In a frame of another page the wheel and one finger scroll that page, until a click or a tap takes the frame into
    // use; a click elsewhere gives it back. A frame out of sight rests.
    framed: false,
    used: true,
    seen: true,
    lost: false,  // what draws was taken away
    use: (used) => {
      tyglabPage.used = used || !tyglabPage.framed;
      Module.canvas.style.touchAction = tyglabPage.used ? 'none' : 'manipulation';
    },
    listenToFrame: (canvas) => {
      tyglabPage.framed = window.parent !== window;
      tyglabPage.use(false);
      if (!tyglabPage.framed) return;
      new IntersectionObserver((entries) => {
        const seen = entries[entries.length - 1].isIntersecting;
        if (seen === tyglabPage.seen || tyglabPage.lost) return;
        tyglabPage.seen = seen;
        _tyglab_on_sight(Number(seen));
      }).observe(canvas);
    },
    tapped: null,  // a finger in a frame not in use: where it went down
    waitForTap: (event) => {
      const {pointerId, clientX, clientY} = event, before = tyglabPage.tapped;
      if (event.type === 'pointerdown') return void (tyglabPage.tapped = before ? null : {pointerId, clientX, clientY});
      if (event.type === 'pointermove' || before?.pointerId !== pointerId) return;
      tyglabPage.tapped = null;
      if (event.type !== 'pointerup' || Math.hypot(clientX - before.clientX, clientY - before.clientY) > 10) return;
      Module.canvas.focus({preventScroll: true});
      tyglabPage.use(true);
      for (const phase of [0, 2]) _tyglab_on_finger(pointerId, phase, ...tyglabPage.at(event));
    },
    // A keyboard on the screen composes words and takes them back, so what changed in the field is what was typed. The
    // field begins with spaces that can be deleted.
    startField: () => {
      const field = tyglabPage.field;
      if (field === null) return;
      field.value = '\u00a0'.repeat(32);
      tyglabPage.typed = [...field.value];
      field.focus({preventScroll: true});
    },
    followField: (event) => {
      const before = tyglabPage.typed, now = [...tyglabPage.field.value];
      let same = 0;
      while (same < Math.min(before.length, now.length) && before[same] === now[same]) ++same;
      for (let n = same; n < before.length; ++n) for (const down of [1, 0]) _tyglab_on_key(tyglabPage.codes.Backspace, down, 0);
      for (const letter of now.slice(same)) _tyglab_on_character(letter.codePointAt(0));
      tyglabPage.typed = now;
      if (now.length < 8 && !event.isComposing) tyglabPage.startField();
    },
    mods: (event) => (event.shiftKey ? 1 : 0) | (event.ctrlKey || event.metaKey ? 2 : 0) | (event.altKey ? 4 : 0),
    key: (event) => {
      const letter = event.key.length === 1 ? event.key.toUpperCase() : '';
      if (/^[A-Z0-9]$/.test(letter)) return letter.charCodeAt(0);
      if (/^(Key[A-Z]|Digit[0-9])$/.test(event.code)) return event.code.charCodeAt(event.code.length - 1);
      if (/^Numpad[0-9]$/.test(event.code)) return 320 + Number(event.code[6]);
      return tyglabPage.codes[event.code] ?? -1;
    },
    pressed: (event) => {
      if (event.isComposing || event.keyCode === 229) return;  // its text comes when it is composed
      const ctrl = event.ctrlKey || event.metaKey, key = tyglabPage.key(event);
      if (key < 0 || (ctrl && tyglabPage.kept[Number(event.shiftKey)].includes(event.key.toLowerCase()))) return;
      if (ctrl && !event.altKey && event.key.toLowerCase() === 'v') return;  // its text comes with the event 'paste'
      event.preventDefault();
      _tyglab_on_key(key, event.repeat ? 2 : 1, tyglabPage.mods(event));
      if (!ctrl && !event.altKey && [...event.key].length === 1) _tyglab_on_character(event.key.codePointAt(0));
    },
    pasted: (event) => {
      tyglabPage.withText(event.clipboardData.getData('text/plain'), _tyglab_on_clipboard);
      _tyglab_on_key(86, 1, 2);
      _tyglab_on_key(86, 0, 2);
      event.preventDefault();
    },
    withText: (text, call) => {
      const at = stringToNewUTF8(text);
      call(at);
      _free(at);
    },
    // Canvas pixels of an event.
    at: (event) => {
      const box = Module.canvas.getBoundingClientRect();
      return [(event.clientX - box.left) * Module.canvas.width / box.width,
              (event.clientY - box.top) * Module.canvas.height / box.height];
    },
    resized: () => {
      const canvas = Module.canvas, scale = window.devicePixelRatio || 1;
      // A finger needs rows of 44 pixels, where there is room for them: not on a phone, which is narrow one way. There
      // controls are 32 pixels high and are hit up to 6 pixels beside them.
      const touch = matchMedia('(pointer: coarse)').matches;
      const larger = touch && Math.min(canvas.clientWidth, canvas.clientHeight) >= 600 ? 1.6 : 1;
      canvas.width = Math.max(1, Math.round(canvas.clientWidth * scale));
      canvas.height = Math.max(1, Math.round(canvas.clientHeight * scale));
      _tyglab_on_size(canvas.width, canvas.height, scale * larger, touch ? 6 * scale : 0);
    },
    // What a reload or the end of the page would lose is kept. A reload opens the address of when it was asked for, so the
    // tab remembers the present one (page.js).
    leave: () => {
      _tyglab_on_leave();
      try {
        sessionStorage.setItem('tyglab:address', location.href);
      } catch (error) {
        console.warn('Tyglab: this tab cannot store its address: ' + error.message);
      }
    },
    // A file of the person's, put where the program finds it: in the current folder, so that it is told of by its name, and
    // as a path, so that it is neither a link nor a shipped texture.
    take: async (file) => {
      const folder = '/home/web_user/files', path = './' + file.name.replace(/[/\\]/g, '_');
      FS.mkdirTree(folder);
      FS.chdir(folder);
      FS.writeFile(path, new Uint8Array(await file.arrayBuffer()));
      tyglabPage.withText(path, _tyglab_on_drop);
    },
    // Some questions a browser passes on to the process that draws, which answers once it has drawn everything. Dear ImGui
    // asks them in every frame, so the answers are kept here: SCISSOR_BOX, BLEND_SRC_RGB and the like.
    answerQuickly: (gl) => {
      const get = gl.getParameter.bind(gl), known = {};
      for (const name of [0x0C10, 0x8009, 0x80C8, 0x80C9, 0x80CA, 0x80CB, 0x883D]) known[name] = get(name);
      gl.getParameter = (name) => known[name] ?? get(name);
      gl.isProgram = (program) => program instanceof WebGLProgram;  // none is deleted while it can be asked for
      const follow = (name, keep) => {
        const set = gl[name].bind(gl);
        gl[name] = (...values) => {
          keep(...values);
          set(...values);
        };
      };
      const functions = (from, to, fromAlpha, toAlpha) => {
        [known[0x80C9], known[0x80C8], known[0x80CB], known[0x80CA]] = [from, to, fromAlpha, toAlpha];
      };
      const equations = (color, alpha) => {
        [known[0x8009], known[0x883D]] = [color, alpha];
      };
      follow('scissor', (...box) => { known[0x0C10] = new Int32Array(box); });
      follow('blendFunc', (from, to) => functions(from, to, from, to));
      follow('blendFuncSeparate', functions);
      follow('blendEquation', (both) => equations(both, both));
      follow('blendEquationSeparate', equations);
    },
    finger: (phase) => (event) => {
      if (event.pointerType !== 'touch') return;
      if (!tyglabPage.used) return tyglabPage.waitForTap(event);
      if (phase === 0) {
        Module.canvas.setPointerCapture(event.pointerId);
        tyglabPage.startField();
      }
      _tyglab_on_finger(event.pointerId, phase, ...tyglabPage.at(event));
      event.preventDefault();
    },
    listenToPointer: (canvas) => {
      const mouse = (handle) => (event) => {
        if (event.pointerType !== 'touch') handle(event);
      };
      canvas.addEventListener('pointerdown', mouse((event) => {
        canvas.focus({preventScroll: true});
        canvas.setPointerCapture(event.pointerId);
        tyglabPage.use(true);
        _tyglab_on_pointer(...tyglabPage.at(event));
      }));
      // Further buttons of a mouse come as mouse events alone.
      canvas.addEventListener('mousedown', (event) => {
        _tyglab_on_button(tyglabPage.buttons[event.button] ?? 4, 1, tyglabPage.mods(event));
        event.preventDefault();
      });
      window.addEventListener('mouseup', (event) => {
        if (event.target === canvas) event.preventDefault();
        _tyglab_on_button(tyglabPage.buttons[event.button] ?? 4, 0, tyglabPage.mods(event));
      });
      canvas.addEventListener('pointermove', mouse((event) => _tyglab_on_pointer(...tyglabPage.at(event))));
      canvas.addEventListener('pointerleave', mouse(() => _tyglab_on_inside(0)));
      canvas.addEventListener('pointerdown', tyglabPage.finger(0));
      canvas.addEventListener('pointermove', tyglabPage.finger(1));
      canvas.addEventListener('pointerup', tyglabPage.finger(2));
      canvas.addEventListener('pointercancel', tyglabPage.finger(3));
      for (const kind of ['touchstart', 'touchmove', 'touchend'])  // no mouse is made of them, and no page moves
        canvas.addEventListener(kind, (event) => {
          if (tyglabPage.used) event.preventDefault();
        }, {passive: false});
      canvas.addEventListener('contextmenu', (event) => event.preventDefault());
      canvas.addEventListener('wheel', (event) => {
        if (!tyglabPage.used && !event.ctrlKey) return;
        const line = event.deltaMode === 0 ? 1 / 100 : event.deltaMode === 1 ? 1 / 3 : 1;
        _tyglab_on_wheel(-event.deltaX * line, -event.deltaY * line * (event.ctrlKey ? 5 : 1));
        event.preventDefault();
      }, {passive: false});
    },
    listenToKeys: (canvas) => {
      canvas.tabIndex = 0;
      if (!tyglabPage.framed) canvas.focus({preventScroll: true});
      window.addEventListener('keydown', (event) => {
        if (event.target === tyglabPage.field && event.key.length === 1 && !event.ctrlKey) return;
        tyglabPage.pressed(event);
      });
      window.addEventListener('keyup', (event) => {
        const key = tyglabPage.key(event);
        if (key >= 0) _tyglab_on_key(key, 0, tyglabPage.mods(event));
      });
      window.addEventListener('paste', tyglabPage.pasted);
      window.addEventListener('blur', () => {
        tyglabPage.use(false);
        _tyglab_on_focus(0);
      });
      window.addEventListener('focus', () => {
        tyglabPage.use(true);
        _tyglab_on_focus(1);
      });
    },
  },

  // Copies of the program, each in a worker.
  tyglab_start_copy__deps: ['$tyglabPage'],
  tyglab_start_copy: (number, parts) => {
    tyglabPage.waiting.push({number, parts});
    setTimeout(tyglabPage.beginWaiting);
  },
  tyglab_end_copy__deps: ['$tyglabPage'],
  tyglab_end_copy: (number) => {
    tyglabPage.waiting = tyglabPage.waiting.filter((copy) => copy.number !== number);
    tyglabPage.workers[number]?.terminate();
    delete tyglabPage.workers[number];
  },
  tyglab_report: (bytes, count) => postMessage(HEAPU8.slice(bytes, bytes + count)),

  tyglab_has_canvas: () => (typeof document === 'undefined' ? 0 : 1),

  tyglab_listen__deps: ['$tyglabPage', '$GL'],
  tyglab_listen: () => {
    const canvas = Module.canvas;
    tyglabPage.answerQuickly(GL.currentContext.GLctx);
    tyglabPage.resized();
    new ResizeObserver(tyglabPage.resized).observe(canvas);
    window.addEventListener('resize', tyglabPage.resized);  // zoom
    matchMedia('(pointer: coarse)').addEventListener('change', tyglabPage.resized);  // a mouse is plugged in
    tyglabPage.listenToFrame(canvas);
    tyglabPage.listenToPointer(canvas);
    tyglabPage.listenToKeys(canvas);
    window.addEventListener('pagehide', tyglabPage.leave);
    document.addEventListener('visibilitychange', () => {
      if (document.hidden) tyglabPage.leave();
    });
    canvas.addEventListener('webglcontextlost', () => {
      tyglabPage.lost = true;
      tyglabPage.leave();
      _tyglab_on_sight(0);
      Module.lost?.();
    });
    window.addEventListener('dragover', (event) => event.preventDefault());
    window.addEventListener('drop', (event) => {
      event.preventDefault();
      for (const file of event.dataTransfer.files) tyglabPage.take(file);
    });
    window.addEventListener('hashchange', () => {
      if (location.hash === tyglabPage.shown) return;
      tyglabPage.shown = location.hash;
      tyglabPage.visited = true;
      tyglabPage.withText(location.href.split('#')[0] + (location.hash || '#'), _tyglab_on_drop);
    });
  },

  tyglab_set_title: (title) => {
    document.title = UTF8ToString(title);
  },
  tyglab_tell: (part, words) => {
    document.getElementById(UTF8ToString(part)).textContent = UTF8ToString(words);
  },
  tyglab_prefers: (query) => (matchMedia(UTF8ToString(query)).matches ? 1 : 0),
  tyglab_full_screen: () => {
    if (document.fullscreenElement) document.exitFullscreen();
    else document.documentElement.requestFullscreen?.();
  },
  tyglab_is_full_screen: () => (document.fullscreenElement ? 1 : 0),
  tyglab_is_hidden: () => (document.hidden ? 1 : 0),
  tyglab_set_cursor__deps: ['$tyglabPage'],
  tyglab_set_cursor: (name) => {
    const cursor = UTF8ToString(name);
    if (cursor !== tyglabPage.cursor) Module.canvas.style.cursor = tyglabPage.cursor = cursor;
  },
  tyglab_first_frame: () => Module.firstFrame?.(),

  // At once, and without asking: in frames, and on plain http, the newer clipboard is not there.
  tyglab_copy__deps: ['$tyglabPage'],
  tyglab_copy: (text) => {
    const copied = UTF8ToString(text);
    let given = false;
    const give = (event) => {
      event.clipboardData.setData('text/plain', copied);
      event.preventDefault();
      event.stopImmediatePropagation();
      given = true;
    };
    document.addEventListener('copy', give, true);
    try {
      tyglabPage.took = document.execCommand('copy') && given;
    } catch {
      tyglabPage.took = false;
    }
    document.removeEventListener('copy', give, true);
    if (!tyglabPage.took) Module.showText?.(copied);
  },
  tyglab_clipboard_took__deps: ['$tyglabPage'],
  tyglab_clipboard_took: () => Number(tyglabPage.took),

  // A text field takes keys, so a touch screen shows its keyboard: for a field of the page that nobody sees.
  tyglab_type_by_touch__deps: ['$tyglabPage'],
  tyglab_type_by_touch: (wanted) => {
    if ((tyglabPage.field !== null) === (wanted !== 0) || !matchMedia('(pointer: coarse)').matches) return;
    if (!wanted) {
      tyglabPage.field.remove();
      tyglabPage.field = null;
      Module.canvas.focus({preventScroll: true});
      return;
    }
    const field = tyglabPage.field = document.createElement('input');
    field.setAttribute('aria-label', 'Text for the field in the picture');
    field.style = 'position:fixed;left:0;bottom:0;width:1px;height:1px;opacity:0;border:0;font-size:16px';
    field.autocomplete = field.autocapitalize = 'off';
    field.spellcheck = false;
    field.enterKeyHint = 'done';
    field.addEventListener('input', tyglabPage.followField);
    document.body.append(field);
    tyglabPage.startField();
  },

  tyglab_hand_out: (file) => {
    const path = UTF8ToString(file), link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([FS.readFile(path)]));
    link.download = path.slice(path.lastIndexOf('/') + 1);
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  },

  tyglab_ask_for_file__deps: ['$tyglabPage'],
  tyglab_ask_for_file: (endings) => {
    const input = document.createElement('input');
    input.type = 'file';
    input.accept = UTF8ToString(endings);
    input.addEventListener('change', () => {
      for (const file of input.files) tyglabPage.take(file);
    });
    input.click();
  },

  // localStorage holds text: JSON as it is, and nothing large. It belongs to the page, whichever thread asks.
  tyglab_keep_files__proxy: 'sync',
  tyglab_keep_files: (folder) => {
    if (typeof document === 'undefined' || Module.embedded) return 1;  // a course's page changes nothing
    const keep = (path) => {
      for (const name of FS.readdir(path)) {
        const inside = path + '/' + name;
        if (name === '.' || name === '..') continue;
        if (FS.isDir(FS.stat(inside).mode)) keep(inside);
        else if (name.endsWith('.json')) localStorage.setItem('tyglab:' + inside, FS.readFile(inside, {encoding: 'utf8'}));
      }
    };
    try {
      keep(UTF8ToString(folder));
      return 1;
    } catch (error) {  // where storage is blocked its very name throws
      console.warn('Tyglab: nothing can be stored: ' + error.message);
      return 0;
    }
  },

  tyglab_page_address: (text, bytes) => {
    if (typeof location === 'undefined') return 0;
    return stringToUTF8(location.href.split(/[?#]/)[0], text, bytes);
  },
  tyglab_show_in_address__deps: ['$tyglabPage'],
  tyglab_show_in_address: (link, lab, step, further) => {
    const shown = UTF8ToString(link), played = UTF8ToString(lab), at = played && step > 1 ? String(step) : '', add = further && !tyglabPage.visited;
    tyglabPage.visited = false;
    if (typeof history === 'undefined') return;
    const asked = new URLSearchParams(location.search);
    let search = location.search;
    const values = Object.entries({lab: played, step: at});
    if (values.some(([key, value]) => (asked.get(key) || '') !== value)) {
      for (const [key, value] of values) {
        if (value) asked.set(key, value);
        else asked.delete(key);
      }
      search = asked.size ? '?' + asked.toString().replace(/=(?=&|$)/g, '') : '';
    }
    if (shown === tyglabPage.shown && search === location.search) return;
    try {
      history[add ? 'pushState' : 'replaceState'](null, '', location.pathname + search + shown);
      tyglabPage.shown = shown;
    } catch (error) {  // in a sandboxed frame
      console.warn('Tyglab: the address cannot follow: ' + error.message);
    }
  },
});
