"""Videos in a headless Chromium, as a page plays them: to their end, for as long as the film, in the frames' colours."""

import base64

from harness import main, needs
from studio_browser import Browser
from videos_test import VideoTest, a_film

FRAMES, SIZE = 6, (160, 90)
# Plays all of a video; then what the page knows of it, and the pixels that it shows at the end.
PLAY = """
const [data, type, places, done] = arguments;
const video = document.createElement("video");
const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
video.muted = true;
video.onerror = () => done({error: video.error.message});
video.onended = () => {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [video.videoWidth, video.videoHeight];
  const context = canvas.getContext("2d");
  context.drawImage(video, 0, 0);
  const pixels = places.map(([x, y]) => [...context.getImageData(x, y, 1, 1).data].slice(0, 3));
  done({size: [canvas.width, canvas.height], duration: video.duration, pixels});
};
video.src = URL.createObjectURL(new Blob([bytes], {type}));
video.play();
"""


class Videos(VideoTest):
    @needs("ffmpeg", "ffprobe")
    def test_a_page_plays_them_in_the_colours_of_the_frames(self):
        film = self.write("film.json", a_film(FRAMES, SIZE))
        self.render(film, "-o", "out", "-o", "film.mp4", "-o", "film.webm")
        last = self.frames("out")[-1]
        places = [(x, 45) for x in (6, 32, 63, 96)]  # the ground and three boxes, away from edges
        with Browser() as browser:
            for kind in ("mp4", "webm"):
                data = base64.b64encode((self.folder / f"film.{kind}").read_bytes()).decode()
                shown = browser.driver.execute_async_script(PLAY, data, f"video/{kind}", places)
                self.assertNotIn("error", shown, kind)
                self.assertEqual(shown["size"], list(SIZE), kind)
                self.assertAlmostEqual(shown["duration"], FRAMES / 24, delta=0.02, msg=kind)
                for (x, y), pixel in zip(places, shown["pixels"]):
                    self.assert_near(pixel, last[y][3 * x:3 * x + 3], (kind, x))

    def assert_near(self, pixel, frame, where):
        """Red and green show the matrix: that of BT.601 would make them wrong by more than 20 levels. Chromium's blue is
        inexact: 255 was shown as 241."""
        for channel, slack in enumerate((4, 4, 20)):
            self.assertAlmostEqual(pixel[channel], frame[channel], delta=slack, msg=(*where, pixel, *frame))


if __name__ == "__main__":
    main()
