// Makes a JPEG of each picture that it gets, and answers with it. A worker: the page stays free for the next picture.
"use strict";
let canvas = null, context = null;

onmessage = async ({ data }) => {
  const { bitmap, captured, quality } = data;
  if (!canvas || canvas.width !== bitmap.width || canvas.height !== bitmap.height) {
    canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    context = canvas.getContext("2d", { alpha: false, desynchronized: true });
  }
  context.drawImage(bitmap, 0, 0);
  bitmap.close();
  try {
    const jpeg = await (await canvas.convertToBlob({ type: "image/jpeg", quality })).arrayBuffer();
    postMessage({ jpeg, captured }, [jpeg]);
  } catch (error) {
    postMessage({ jpeg: null, captured });
  }
};
