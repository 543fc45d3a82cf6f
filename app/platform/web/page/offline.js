// A service worker: what the page is made of is kept at the first visit, so that it opens without a network afterwards.
// Of the programs, the page names the one that it uses.
const version = 'tyglab-VERSION', used = new URLSearchParams(self.location.search).get('program');
const files = FILES.filter((name) => !/^tyglab(-threads)?\.(js|wasm)$/.test(name) || name.startsWith(used + '.'));

self.addEventListener('install', (event) => {
  event.waitUntil(caches.open(version).then((cache) => cache.addAll(files)).then(() => self.skipWaiting()));
});

self.addEventListener('activate', (event) => {
  event.waitUntil(caches.keys()
    .then((names) => Promise.all(names.filter((name) => name.startsWith('tyglab-') && name !== version).map((old) => caches.delete(old))))
    .then(() => self.clients.claim()));
});

// What was kept is of one version, whole; the next version is kept beside it and takes its place when it is complete.
self.addEventListener('fetch', (event) => {
  if (event.request.method !== 'GET' || new URL(event.request.url).origin !== location.origin) return;
  event.respondWith(caches.open(version).then(async (cache) => {
    const kept = await cache.match(event.request, {ignoreSearch: true});
    return kept ?? fetch(event.request);
  }));
});
