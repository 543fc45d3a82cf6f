// A copy of the program at work beside the page (app/platform/copies.h): its memory comes with the message.
importScripts('tyglab.js');

onmessage = async ({data: {module, pieces, parts}}) => {
  const tyglab = await createTyglab({
    noInitialRun: true,
    instantiateWasm: (imports, take) => {
      WebAssembly.instantiate(module, imports).then((instance) => take(instance, module));
      return {};
    },
  });
  tyglab.tyglabPage.becomeCopy(pieces, parts);
};
