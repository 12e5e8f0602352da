"""What holds a piece together by too little, and goes to its neighbour."""
