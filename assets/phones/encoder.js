// Makes a JPEG of each picture that it gets, and answers with it. A worker: the page stays free for the next picture.
"use strict";
let canvas = null, context = null;

onmessage = async ({ data }) => {
  const { picture, captured, quality } = data, width = picture.displayWidth || picture.width, height = picture.displayHeight || picture.height;
  if (!canvas || canvas.width !== width || canvas.height !== height) {
    canvas = new OffscreenCanvas(width, height);
    context = canvas.getContext("2d", { alpha: false });
  }
  context.drawImage(picture, 0, 0, width, height);
  picture.close();
  try {
    const jpeg = await (await canvas.convertToBlob({ type: "image/jpeg", quality })).arrayBuffer();
    postMessage({ jpeg, captured }, [jpeg]);
  } catch (error) {
    postMessage({ jpeg: null, captured });
  }
};
